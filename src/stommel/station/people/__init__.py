"""Who may do what: users, sessions, tokens, limits, and who holds command of a vehicle."""
