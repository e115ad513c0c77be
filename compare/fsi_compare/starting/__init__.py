"""Starting the programs: where they are, as processes of which none outlives fsi-compare, one study in a folder."""
