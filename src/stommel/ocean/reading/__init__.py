"""From files of the field to a grid: axes, variables, regions, series of files."""
