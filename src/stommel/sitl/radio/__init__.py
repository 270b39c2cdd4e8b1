"""The radio in the loop: the air between the vehicle and a shore, as the plant and the scenario let it through."""
