"""Exit statuses of the command; 0 is an answer."""

USAGE_ERROR, DEFECT, INTERRUPTED = 2, 1, 130
