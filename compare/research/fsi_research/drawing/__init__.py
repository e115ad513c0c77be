"""What pictures of several kinds need: logarithmic axes, names at points."""
