"""What the station keeps: every frame as it came, what it says, and what people did."""
