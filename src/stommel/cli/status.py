"""Exit statuses of the command; 0 is an answer."""

USAGE_ERROR, DEFECT, INTERRUPTED = 2, 1, 130
START_AGAIN = 75
"""The shore asked that the vehicle's software starts anew; EX_TEMPFAIL of sysexits.h, a temporary failure."""
CLOSED_PIPE = 141
"""The reader of the answer has gone: as a shell says of a program that the signal SIGPIPE ended, 128 + 13."""
