"""`fsi-compare solvers`: single Newton systems by many linear solvers, and their tables and pictures."""
