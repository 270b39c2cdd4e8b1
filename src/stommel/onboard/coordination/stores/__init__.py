"""What the coordination computer keeps through a loss of power: missions, and the storage below them."""
