"""Kind `scaling`: one case on more and more processes."""
