"""What the metal does: buoyancy engine, drives, power and pressure hull, as design, simulation and bench share them."""
