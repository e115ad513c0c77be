"""Starting the programs: where they are, and as processes of which none outlives fsi-compare."""
