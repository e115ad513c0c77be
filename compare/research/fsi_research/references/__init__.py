"""Kind `references`: known numbers by both drivers, with error bars."""
