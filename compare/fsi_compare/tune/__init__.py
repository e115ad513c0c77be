"""The command `tune`: Windkessels for given pressures and flow splits."""
