"""Style and saving of every picture."""
