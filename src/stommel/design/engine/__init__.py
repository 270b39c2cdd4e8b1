"""Study of the buoyancy engine for a design, and its figure."""
