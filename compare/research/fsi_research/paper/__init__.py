"""The kind `paper`: the paper's tables, figures and claims beside ours."""
