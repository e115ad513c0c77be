"""A report's view of the vessel in space: surfaces of the runs with fields over time, packed for
templates/scene*.js."""

from dataclasses import dataclass, field
from typing import Any, Sequence

import numpy as np

from ..base import interruption
from ..drawing.colours import DIVERGING, PERCENTILE, SEQUENTIAL, Scale, scale_of, scale_of_difference, table
from ..drawing.sweep import angles
from ..results.picture import Scene
from ..results.quantities import Quantity
from ..results.scene_parts import Part, views_of
from ..results.units import time_words
from ..runs.levels import thinned
from .scene_packing import packed_counts, packed_numbers, plain_bytes, short
from .scene_thinning import MOST_TRIANGLES, thinned_part

MOST_NUMBERS = 8_000_000  # of all fields in a page, 16 bits each; 1 to 1.5 bytes each when deflated, in base64
MOST_FRAMES = 100  # times, unless asked otherwise
FEWEST_FRAMES = 8


@dataclass
class RunScene:
    """A run, as much of it as a page holds."""

    name: str
    scene: Scene
    parts: list[Part]
    times: np.ndarray  # ms, (frames,)
    fields: dict[str, np.ndarray] = field(default_factory=dict)  # "part/field" -> (frames, points[, components])
    apart: bool = False  # stored as differences from the first run, which has the same points and times

    def levels(self, part: Part, key: str) -> list[np.ndarray]:
        """Values of a part at each time; empty where it has none."""
        quantity = self.scene.quantities.get(key, {}).get(part.surface.medium.name)
        values = None if quantity is None else self.fields.get(f"{part.name}/{quantity.field}")
        return [] if quantity is None or values is None else [quantity.of(level) for level in values]


class ReportScene:
    """The scene of one or several runs. `notes` say what was left out."""

    def __init__(self, names: Sequence[str], scenes: Sequence[Scene], frames: int | None = None) -> None:
        self.notes: list[str] = []
        self.runs = [RunScene(name, scene, *self._thinned(name, scene)) for name, scene in zip(names, scenes)]
        self._choose_times(frames)
        for run in self.runs:
            self._read(run)
        for run in self.runs[1:]:
            self._compare(run)

    def _thinned(self, name: str, scene: Scene) -> Any:
        parts = []
        count = sum(len(part.surface.triangles) for part in scene.parts)
        for part in scene.parts:
            thin = thinned_part(part, count)
            parts += [thin] if len(thin.surface.triangles) else []
        kept = sum(len(part.surface.triangles) for part in parts)
        if kept < count:
            self.notes.append(
                f"{name}: {kept:,} of {count:,} triangles are shown, since a page is kept to {MOST_TRIANGLES:,}; their corners are "
                "nodes of the mesh, with their own values."
            )
        return parts, np.zeros(0)

    def _choose_times(self, frames: int | None) -> None:
        """Chooses times: at most `frames`, and as many as the page may hold."""
        parts = [part for run in self.runs for part in run.parts]
        shown = [(part.surface, name) for part in parts for name in part.surface.names if part.shows(name)]
        a_time = sum(len(surface.ends) * surface.medium.width(name) for surface, name in shown)  # 16-bit numbers
        most = max(FEWEST_FRAMES, min(frames or MOST_FRAMES, MOST_NUMBERS // max(a_time, 1)))
        for run in self.runs:
            times = np.unique(np.concatenate([medium.times for medium in run.scene.meshes.media.values()]))
            run.times = times[thinned(len(times), most)]
            if len(run.times) < len(times):
                asked = "" if frames and most >= frames else f" (a page holds {MOST_NUMBERS:,} numbers)"
                self.notes.append(f"{run.name}: {len(run.times)} of {len(times)} times of fields.h5 are shown{asked}.")

    def _read(self, run: RunScene) -> None:
        """Reads each field of a medium once, for all parts."""
        for medium in run.scene.meshes.media.values():
            for name in medium.names:
                parts = [part for part in run.parts if part.surface.medium is medium and part.shows(name)]
                levels: list[list[np.ndarray]] = [[] for _ in parts]
                # Where a field begins later or ends earlier its own first or last time.
                of_field = medium.times_of(name)
                for time in np.clip(run.times, of_field[0], of_field[-1]) if parts else np.zeros(0):
                    interruption.check()
                    values = medium.at(float(time), name)
                    for found, part in zip(levels, parts):
                        found.append(part.surface.take(values))
                run.fields.update({f"{part.name}/{name}": np.array(found) for part, found in zip(parts, levels)})

    def _compare(self, run: RunScene) -> None:
        first, other = self.runs[0], ""
        if not same_points(first, run):
            other = "on another mesh"
        elif first.times.shape != run.times.shape or not np.allclose(first.times, run.times, rtol=1e-6):
            other = "at other times"
        if other:
            words = f"its fields are {other} than those of {first.name}; no difference is shown."
            self.notes.append(f"{run.name}: {words}")
        run.apart = not other and set(run.fields) == set(first.fields)

    def values(self) -> dict[str, Any]:
        """The data of the page's element."""
        scene, maps = self.runs[0].scene, {name: plain_bytes(table(name)) for name in (SEQUENTIAL, DIVERGING)}
        content: dict[str, Any] = {"runs": [self._run(run) for run in self.runs], "quantities": self._quantities()}
        content |= {"first": scene.first, "start": scene.peak(scene.first), "views": self._views()}
        content |= {"plane": self._plane(), "box": self._box(), "flat": scene.meshes.flat}
        content |= {"turned": scene.meshes.geometry == "axisymmetric", "angles": short(angles())}
        content |= {"percentile": PERCENTILE, "maps": maps, "clock": time_words("{}", scene.static, "t = ")}
        return {"content": content, "notes": list(dict.fromkeys(self.notes))}

    def _run(self, run: RunScene) -> dict[str, Any]:
        parts = [self._part(run, part) for part in run.parts]
        return {"name": run.name, "times": short(run.times), "parts": parts, "apart": run.apart}

    def _part(self, run: RunScene, part: Part) -> dict[str, Any]:
        prefix, first = f"{part.name}/", self.runs[0].fields
        fields = {name: values for name, values in run.fields.items() if name.startswith(prefix)}
        if run.apart:
            fields = {name: values - first[name] for name, values in fields.items()}
        surface = part.surface
        made: dict[str, Any] = {"name": part.name, "group": part.group, "medium": surface.medium.name}
        made |= {"corners": surface.triangles.shape[1], "points": packed_numbers(surface.points)}
        made |= {"cells": packed_counts(surface.triangles), "nodes": packed_counts(surface.nodes)}
        packed = {name.removeprefix(prefix): packed_numbers(values) for name, values in fields.items()}
        return {**made, "between": part.group == "cut", "fields": packed}

    def _quantities(self) -> list[dict[str, Any]]:
        keys: dict[str, Quantity] = {}
        for run in self.runs:
            for key in run.scene.quantities:
                keys.setdefault(key, run.scene.quantity(key))
        return [self._quantity(key, quantity) for key, quantity in keys.items()]

    def _quantity(self, key: str, quantity: Quantity) -> dict[str, Any]:
        media = sorted({name for run in self.runs for name in run.scene.quantities.get(key, {})})
        scale = scale_of((level for run in self.runs for level in self.levels(run, key)), quantity.signed)
        part = quantity.key.partition(":")[2]
        return {
            "key": key,
            "field": quantity.field,
            "part": {"x": 0, "y": 1, "z": 2, "1": 0, "2": 1, "3": 2}.get(part, -1),
            "media": media,
            "words": words_of(key, quantity),
            "unit": quantity.shown_unit,
            **_scale(scale),
            "apart": [_scale(scale_of_difference(self.apart(run, key))) for run in self.runs[1:]],
        }

    def levels(self, run: RunScene, key: str) -> list[np.ndarray]:
        """Values of each part at each time."""
        return [level for part in run.parts for level in run.levels(part, key)]

    def apart(self, run: RunScene, key: str) -> list[np.ndarray]:
        """Differences from the first run."""
        return [b - a for a, b in zip(self.levels(self.runs[0], key), self.levels(run, key))] if run.apart else []

    def _box(self) -> dict[str, Any]:
        points = np.concatenate([part.surface.points for run in self.runs for part in run.parts])
        return {"low": short(points.min(axis=0)), "high": short(points.max(axis=0))}

    def _plane(self) -> dict[str, Any] | None:
        plane = self.runs[0].scene.plane
        return None if plane is None else {"origin": short(plane.origin), "normal": short(plane.normal)}

    def _views(self) -> list[dict[str, Any]]:
        found: list[dict[str, Any]] = []
        for name, camera, target in views_of(self.runs[0].scene.meshes):
            view = {"name": name, "towards": short(camera.axes[2]), "up": short(camera.axes[1])}
            found.append(view if target is None else {**view, "target": short(target)})
        return found


def words_of(key: str, quantity: Quantity) -> str:
    return quantity.words + (" in the wall" if key.startswith("wall_pressure") else "")


def same_points(first: RunScene, other: RunScene) -> bool:
    """Whether two runs have the same parts of the same mesh."""
    if [part.name for part in first.parts] != [part.name for part in other.parts]:
        return False
    pairs = [(a.surface.points, b.surface.points) for a, b in zip(first.parts, other.parts)]
    return all(a.shape == b.shape and np.allclose(a, b, rtol=0, atol=1e-9 * np.ptp(a)) for a, b in pairs)


def _scale(scale: Scale) -> dict[str, Any]:
    ends: dict[str, float] = {"low": scale.low, "high": scale.high, "least": scale.least, "largest": scale.largest}
    found: dict[str, Any] = {name: float(f"{end:.6g}") if np.isfinite(end) else None for name, end in ends.items()}
    return {**found, "diverging": scale.diverging, "map": scale.map}
