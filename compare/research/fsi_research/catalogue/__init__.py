"""What the studies know beforehand: names of materials, meshes and linear solvers, and the paper's numbers."""
