"""What all parts share: errors, names in cases, files, interruption, options, streams."""
