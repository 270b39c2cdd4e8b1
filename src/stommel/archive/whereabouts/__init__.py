"""Where vehicles were, out of all the positions that they told: those that they can have been at."""
