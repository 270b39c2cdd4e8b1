"""The CTD: Sea-Bird's Glider Payload CTD."""
