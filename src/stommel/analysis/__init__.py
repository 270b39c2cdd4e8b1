"""What the equations imply for a design: trim, turning flight, envelope, linearisation, modes, root locus."""
