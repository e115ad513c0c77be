"""A result folder as arrays with units: what `import fsi_compare` hands out (docs/python.md)."""
