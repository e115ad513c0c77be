"""Starts the other programs as a user would, reads their result folders and compares them; never looks inside them."""
