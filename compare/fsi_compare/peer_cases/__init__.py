"""Cases of other programs as case files of ours: one reader a format, one model, one writer."""
