"""The gallery: scenes that others can start from, each with a number that is known, run by both drivers."""
