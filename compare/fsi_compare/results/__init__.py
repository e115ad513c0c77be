"""A result folder as arrays with units: what `import fsi_compare` hands out (docs/guide/reports.md#python)."""
