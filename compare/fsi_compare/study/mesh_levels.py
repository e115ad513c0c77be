"""The meshes of the artery that a case file names by `mesh.level`, as tables call them, and how large they are."""

MESHES = {"coarse": "C", "intermediate": "I", "fine": "F"}
MESH_NODES = {"coarse": 1e3, "intermediate": 7e3, "fine": 55e3}  # about, to weigh the work of runs
