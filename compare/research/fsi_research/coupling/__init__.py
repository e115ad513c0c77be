"""The kind `coupling`: the schemes of the partitioned driver."""
