"""The vehicle's end of the radio link: what the coordination software tells the shore, and what the shore may ask."""
