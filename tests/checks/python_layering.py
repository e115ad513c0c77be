"""python_layering.py ROOT: the modules of fsi_compare and fsi_research import downwards only, and never in a circle.

The Python counterpart of layering.py. A module may import from its own package and from the floors below it; packages on
the same floor do not know each other. Imports within functions count too. fsi_compare is the product, and stands below
fsi_research, the studies of this project. LIBRARY, which is what users import, sees neither the commands that start
programs nor the command line. Besides themselves they import the standard library and LIBRARIES, so that they cannot
come to lean on tests or scripts.
"""

import ast
import sys
from pathlib import Path

from circles import circles

PACKAGES = {  # folder of each
    "fsi_compare": "compare/fsi_compare",
    "known_solutions": "gallery/known_solutions",
    "fsi_research": "compare/research/fsi_research",
}
# Lowest first. Packages of one line share a floor; "fsi_compare" is what lies beside them, with its command line.
FLOORS = (
    ("fsi_compare.base",),
    ("fsi_compare.runs", "fsi_compare.mesh_import", "fsi_compare.drawing"),
    ("fsi_compare.results", "fsi_compare.peer_cases"),
    ("fsi_compare.reporting",),
    ("fsi_compare.starting",),
    ("fsi_compare.gallery",),
    ("known_solutions",),
    ("fsi_compare.study",),
    ("fsi_compare.verify",),
    ("fsi_compare.tune",),
    ("fsi_compare",),
    ("fsi_research.catalogue", "fsi_research.drawing"),
    ("fsi_research.linear",),
    ("fsi_research.evidence",),
    (
        "fsi_research.accuracy",
        "fsi_research.calibration",
        "fsi_research.coupling",
        "fsi_research.paper",
        "fsi_research.references",
        "fsi_research.scaling",
        "fsi_research.scenes",
        "fsi_research.skip",
        "fsi_research.stability",
    ),
    ("fsi_research",),
)
OF_LIBRARY = tuple(package for floor in FLOORS[:4] for package in floor)  # what it may import
LIBRARY = ("fsi_compare", "fsi_compare.library")  # modules: what `import fsi_compare` is
LIBRARIES = ("numpy", "matplotlib", "h5py", "meshio", "netCDF4", "jinja2", "markupsafe")
# Imports by a name that is computed are seen by no check: only of commands and kinds of study, which are loaded when they are asked for.
COMPUTED = ("fsi_compare.cli", "fsi_compare.study.catalogue")


def source_files(root):
    """Paths of the modules, relative to the root."""
    folders = PACKAGES.values()
    return sorted(path.relative_to(root).as_posix() for folder in folders for path in (root / folder).rglob("*.py"))


def module_of(path):
    """'fsi_compare.runs.columns' for compare/fsi_compare/runs/columns.py; a package is named by its folder."""
    parts = _parts(path)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def package_of(path):
    return ".".join(_parts(path)[:-1])


def _parts(path):
    for package, folder in PACKAGES.items():
        if Path(folder) in Path(path).parents:
            return (package, *Path(path).relative_to(folder).with_suffix("").parts)
    raise ValueError(path)


def allowed_packages(package):
    """Its own and those of the floors below; None when it is on no floor."""
    for number, floor in enumerate(FLOORS):
        if package in floor:
            return [name for below in FLOORS[:number] for name in below] + [package]
    return None


def may_import(path, target, allowed):
    """Whether a module of a package with these allowed packages may import the module `target`."""
    if module_of(path) not in LIBRARY:
        return package_of(target) in allowed
    return module_of(target) in LIBRARY or package_of(target) in OF_LIBRARY


def imports(root, path, modules):
    """(line, text, path) of each import of a module of PACKAGES, (line, text, None) of any other that will not do.
    `modules`: path of each by its name."""
    tree = ast.parse((root / path).read_text(encoding="utf-8"), path)
    package = package_of(path).split(".")
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield from _absolute(node.lineno, f"import {alias.name}", alias.name, (), modules)
        elif isinstance(node, ast.ImportFrom):
            names = [alias.name for alias in node.names]
            text = f"from {'.' * node.level}{node.module or ''} import {', '.join(names)}"
            if node.level == 0:
                yield from _absolute(node.lineno, text, node.module, names, modules)
            elif node.level > len(package):
                yield node.lineno, text, None
            else:
                kept = package[: len(package) - node.level + 1]
                yield from _own(
                    node.lineno, text, ".".join(kept + ([node.module] if node.module else [])), names, modules
                )
        elif isinstance(node, ast.Call) and module_of(path) not in COMPUTED:
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            if called in ("import_module", "__import__"):
                yield node.lineno, f"{called}(...)", None


def _absolute(line, text, name, names, modules):
    first = name.partition(".")[0]
    if first in PACKAGES:
        yield from _own(line, text, name, names, modules)
    elif first not in sys.stdlib_module_names and first not in LIBRARIES:
        yield line, text, None


def _own(line, text, name, names, modules):
    """`name` is a module, or a package of which `names` are modules or what its __init__ defines."""
    inside = [f"{name}.{one}" for one in names]
    found = [modules[one] for one in inside if one in modules]
    if len(found) < max(len(names), 1):
        found.append(modules.get(name))
    for path in found:
        yield line, text, path


def wrong_imports(root):
    """One message for each import that goes up, sideways or out of the project, and for each module on no floor."""
    paths = source_files(root)
    modules = {module_of(path): path for path in paths}
    for path in paths:
        package = package_of(path)
        allowed = allowed_packages(package)
        if allowed is None:
            yield f'{path}:1: package "{package}" is on no floor; add it to FLOORS in tests/checks/python_layering.py'
            continue
        for line, text, target in imports(root, path, modules):
            if target is None:
                yield f"{path}:{line}: {text}: neither a module of {', '.join(PACKAGES)} nor one of {', '.join(LIBRARIES)}"
            elif not may_import(path, target, allowed):
                yield f'{path}:{line}: {text} from "{package}"; allowed: {", ".join(allowed)}'


def cycles(root):
    """One message for each circle of imports."""
    paths = source_files(root)
    modules = {module_of(path): path for path in paths}
    graph = {
        path: [(line, target) for line, _, target in imports(root, path, modules) if target is not None]
        for path in paths
    }
    return [f"{path}:{line}: import cycle: {' -> '.join(circle)}" for path, line, circle in circles(graph)]


def main(arguments):
    if len(arguments) != 1 or not (Path(arguments[0]) / PACKAGES["fsi_compare"]).is_dir():
        print("python_layering.py: error: give the root of the repository", file=sys.stderr)
        return 1
    root = Path(arguments[0])
    files = source_files(root)
    if not files:
        print("python_layering.py: error: no modules found", file=sys.stderr)
        return 1
    messages = list(wrong_imports(root)) + cycles(root)
    for message in messages:
        print(message)
    print(f"{len(files)} modules, {len(messages)} problems")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
