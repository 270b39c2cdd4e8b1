"""Commands over the radio: each executed once, or not at all, and its sender hears which."""
