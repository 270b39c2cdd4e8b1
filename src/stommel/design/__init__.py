"""From analysis to a design: specification check, tables, envelope, modes, root loci, and their report."""
