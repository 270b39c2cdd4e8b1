"""What a mission leaves: rows of the log, Dataset, summary, CTD samples."""
