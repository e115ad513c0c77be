"""Known solutions that several scenes of the gallery share: their scene.py import them, fsi-compare does not."""
