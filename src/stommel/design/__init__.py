"""From analysis to a design: hull, engine, drives, masses, endurance, specification, and the whole design study."""
