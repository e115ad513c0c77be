"""Starting the programs and reading what their runs left."""
