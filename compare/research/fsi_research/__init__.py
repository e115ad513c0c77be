"""The studies of this project: its paper, its evidence, its measurements. Run from the source tree by fsi-compare of a
build in it, and not installed; imports fsi_compare, which does not know of it."""
