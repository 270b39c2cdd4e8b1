"""Maps, sections and profiles of an ocean."""
