"""Reads what runs left in their folders, and compares it."""
