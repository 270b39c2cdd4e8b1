"""Motion of a glider, compiled: kinematics (1)-(3), inertia, hydrodynamics, equations of motion (4)-(7)."""
