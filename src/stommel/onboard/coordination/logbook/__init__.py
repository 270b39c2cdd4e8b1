"""The data log: records that are added, checked and kept through a loss of power, and read back."""
