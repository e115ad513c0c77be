"""Makes the runs of a study file, each once, and hands them to the kind of study that evaluates them."""
