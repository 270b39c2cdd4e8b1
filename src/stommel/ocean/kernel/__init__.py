"""What compiled code asks of an ocean: grid, cells, columns of water, the edge of the data."""
