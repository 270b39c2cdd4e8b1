"""What the metal does: buoyancy engine, drives and power, as design, simulation and bench share them."""
