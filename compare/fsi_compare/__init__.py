"""Starts the other programs as a user would, reads their result folders and compares them. It never looks inside them."""
