"""The shore's end of the link: every service of one vehicle, as the terminal and the shore station use it."""
