"""Reads the result folders of finished runs and compares them. It never looks inside the other programs."""
