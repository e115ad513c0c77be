"""What all parts know: errors, names, output files, progress, the numbers of the paper."""
