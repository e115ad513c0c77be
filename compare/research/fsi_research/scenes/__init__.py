"""Kind `scenes`: scenes of the gallery by both drivers, side by side."""
