"""Fields of runs that never happened, on small meshes whose surfaces, areas and values are known: a channel of square section
with a wall on one side, and half planes that are turned about an axis."""

import h5py
import numpy as np

TIMES = np.array([0.0, 1.0, 2.0, 3.0, 4.0])  # ms
LENGTH, WIDTH, WALL = 4.0, 1.0, 0.25  # mm
SPEED = 2.0  # mm/ms at the last time


def boxes(x, y, z):
    """Points and tetrahedra of a box divided at these coordinates, six to each brick."""
    shape = (len(x), len(y), len(z))
    points = np.array([(a, b, c) for a in x for b in y for c in z])
    cells = []
    for i, j, k in np.ndindex(*(n - 1 for n in shape)):
        corner = [np.ravel_multi_index((i + a, j + b, k + c), shape) for a in (0, 1) for b in (0, 1) for c in (0, 1)]
        cells += [
            [corner[n] for n in t]
            for t in ((0, 4, 6, 7), (0, 6, 2, 7), (0, 2, 3, 7), (0, 3, 1, 7), (0, 1, 5, 7), (0, 5, 4, 7))
        ]
    return points, np.array(cells, dtype=np.int32)


def displacement(points, t):
    return np.stack([0.01 * t * points[:, 0], 0 * points[:, 0], 0 * points[:, 0]], axis=1)


def pressure(points, t, factor=1.0):
    return factor * t * (LENGTH - points[:, 2]) / 8  # kPa


def velocity(points, t, factor=1.0):
    """Along z, the same everywhere: what enters at one end leaves at the other."""
    return np.stack([0 * points[:, 0], 0 * points[:, 0], np.full(len(points), factor * SPEED * t / 4)], axis=1)


def shear(points, t, factor=1.0):
    on_wall = np.isclose(points[:, 0], WIDTH)
    return np.stack(
        [0 * points[:, 0], 0 * points[:, 0], np.where(on_wall, factor * 1e-3 * t * points[:, 1], 0)], axis=1
    )


def stress(points, t):
    return 5.0 * t * points[:, 2] / LENGTH


def channel(cells=(2, 2, 6)):
    n, m, k = cells
    y, z = np.linspace(0, WIDTH, m + 1), np.linspace(0, LENGTH, k + 1)
    return {"fluid": boxes(np.linspace(0, WIDTH, n + 1), y, z), "wall": boxes(np.array([WIDTH, WIDTH + WALL]), y, z)}


def channel_fields(factor=1.0):
    """Of each medium: (unit, values at points and a time) by name."""
    return {
        "fluid": {
            "displacement": ("mm", displacement),
            "pressure": ("kPa", lambda p, t: pressure(p, t, factor)),
            "velocity": ("mm/ms", lambda p, t: velocity(p, t, factor)),
            "wall_shear_stress": ("kPa", lambda p, t: shear(p, t, factor)),
        },
        "wall": {"displacement": ("mm", displacement), "von_mises_stress": ("kPa", stress)},
    }


def write_fields(folder, mesh=None, fields=None, times=TIMES, factor=1.0):
    """fields.h5 and openings.csv of the channel, as the drivers write them."""
    mesh, fields = mesh or channel(), fields or channel_fields(factor)
    with h5py.File(folder / "fields.h5", "w") as h5:
        h5["steps/number"] = np.arange(len(times), dtype=np.int64)
        h5["steps/time"] = times
        for medium, (points, cells) in mesh.items():
            h5[f"{medium}/points"], h5[f"{medium}/cells"] = points, cells
            for name, (unit, values) in fields[medium].items():
                group = h5.create_group(f"{medium}/{name}")
                group.attrs["unit"] = np.bytes_(unit)
                for number, time in enumerate(times):
                    group[f"{number:08d}"] = values(points, time)
                h5[f"steps/written/{medium}.{name}"] = np.ones(len(times), dtype=np.uint8)
    lines = ["time_ms,opening,flow_mm3_per_ms,mean_pressure_Pa,windkessel_pressure_Pa"]
    for t in times[1:]:
        flow = factor * SPEED * t / 4 * WIDTH**2 * (1 + 0.01 * t)  # through openings that are displaced
        lines += [f"{t},in<b>,{-flow},{1000 * factor * t * LENGTH / 8},0", f"{t},out,{flow},0,0"]
    (folder / "openings.csv").write_text("\n".join(lines) + "\n")
    return folder


def half_plane(radius=2.0, length=10.0, cells=(8, 10)):
    """Triangles of (r, 0, z)."""
    r, z = np.linspace(0, radius, cells[0] + 1), np.linspace(0, length, cells[1] + 1)
    points = np.array([(a, 0.0, c) for a in r for c in z])
    triangles = []
    for i, k in np.ndindex(*cells):
        a, b = i * len(z) + k, (i + 1) * len(z) + k
        triangles += [[a, b, b + 1], [a, b + 1, a + 1]]
    return points, np.array(triangles, dtype=np.int32)


def write_turned(folder, times=TIMES, radius=2.0, length=10.0):
    """Steady flow along a rigid pipe: fluid alone."""
    points, cells = half_plane(radius, length)
    along = lambda p, t: np.stack([0 * p[:, 0], 0 * p[:, 0], t * (1 - (p[:, 0] / radius) ** 2)], axis=1)
    fields = {
        "velocity": ("mm/ms", along),
        "pressure": ("kPa", lambda p, t: t * (length - p[:, 2]) / length),
        "wall_shear_stress": ("kPa", lambda p, t: np.where(p[:, :1] == radius, [[0.0, 0.0, 0.01 * t]], 0.0)),
    }
    write_fields(folder, {"fluid": (points, cells)}, {"fluid": fields}, times)
    flow = np.pi * radius**2 / 2
    lines = ["time_ms,opening,flow_mm3_per_ms,mean_pressure_Pa,windkessel_pressure_Pa"]
    for t in times[1:]:
        lines += [f"{t},inlet,{-t * flow},{1000 * t},0", f"{t},outlet,{t * flow},0,0"]
    (folder / "openings.csv").write_text("\n".join(lines) + "\n")
    return folder
