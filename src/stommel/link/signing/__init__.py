"""Who may speak: signatures, time stamps, keys and their change; all checks of a frame meet in the guard."""
