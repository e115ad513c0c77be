"""The kind `stability`: where each method works, and what is said where it does not."""
