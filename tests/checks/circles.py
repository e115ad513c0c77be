"""Circles in a graph of files, found by depth-first search."""


def circles(graph):
    """`graph`: name -> [(line, name that it needs)]. (name, line, circle) for each edge that closes a circle; the circle
    is the list of its names, the first one again at the end."""
    finished = set()
    found = []

    def visit(name, trail):
        for line, target in graph.get(name, ()):
            if target in trail:
                found.append((name, line, trail[trail.index(target) :] + [target]))
            elif target not in finished:
                visit(target, trail + [target])
        finished.add(name)

    for name in graph:
        if name not in finished:
            visit(name, [name])
    return found
