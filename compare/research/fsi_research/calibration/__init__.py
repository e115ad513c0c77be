"""Kind `calibration`: whether the bars of `fsi-compare verify` hold the true errors."""
