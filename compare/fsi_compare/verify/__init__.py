"""The command `verify`: how wrong a case's results are, from a family of runs around it."""
