"""From the archive to data sets: CTD samples with their places, profiles and sections, piece by piece."""
