"""The execution layer: nodes that move actuators and read sensors, as state machines without any I/O."""
