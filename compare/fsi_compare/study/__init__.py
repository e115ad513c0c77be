"""Making the runs of a study file, each once, and handing them to the kind of study that evaluates them."""
