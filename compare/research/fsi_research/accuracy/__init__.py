"""The kind `accuracy-cost`: error against seconds."""
