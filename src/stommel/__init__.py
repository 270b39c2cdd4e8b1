"""stommel."""
