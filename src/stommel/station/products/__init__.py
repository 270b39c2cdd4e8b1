"""From the archive to data sets."""
