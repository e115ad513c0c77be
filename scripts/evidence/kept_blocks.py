"""What pages say of kept tables beyond the tables themselves: blocks of text that scripts/evidence/kept_pages.py puts on them."""

from statistics import median
from typing import Callable, Dict, List, NamedTuple, Tuple

from kept_tables import Row

DRIVERS = ("monolithic", "partitioned")
KINDS = ("interface", "block", "monolithic")
SAME = 1.1  # ratios of seconds nearer to 1 than this, either way, are no difference: the scatter of short runs


class BlockError(Exception):
    """A table that a block cannot be made of."""


class Kinds(NamedTuple):
    """A scene by each kind of coupling; of the interface kind by the scheme that the driver takes by itself."""

    interface: Row
    block: Row
    monolithic: Row

    @property
    def title(self) -> str:
        return self.monolithic["scene"]

    def at_equal_error(self, kind: str) -> bool:
        """Whether it has the monolithic run's error of the solver."""
        return str(getattr(self, kind)["equal error"]) == "yes"

    def ratio(self, kind: str, column: str) -> float:
        """Over monolithic."""
        return float(getattr(self, kind)[column]) / float(self.monolithic[column])


def kinds(rows: List[Row]) -> List[Kinds]:
    """In the order of the table."""
    found: Dict[str, Dict[str, Row]] = {}
    for row in rows:
        found.setdefault(row["scene"], {}).setdefault(row["kind"], row)  # the default is the first of its kind
    for scene, by in found.items():
        if set(by) != set(KINDS):
            raise BlockError(f"'{scene}' has not a row for each kind")
    return [Kinds(*(by[kind] for kind in KINDS)) for by in found.values()]


def _measured(rows: List[Row], kind: str) -> List[Kinds]:
    """Scenes in which this kind has the monolithic run's error of the solver."""
    found = [scene for scene in kinds(rows) if scene.at_equal_error(kind)]
    if not found:
        raise BlockError(f"no scene is at equal error by '{kind}'")
    return found


def kinds_answer(rows: List[Row]) -> str:
    """What each kind takes, medians over the scenes at equal error."""
    scenes = {kind: _measured(rows, kind) for kind in KINDS}

    def over(column: str) -> List[str]:
        cells = []
        for kind in KINDS[:-1]:
            ratios = [scene.ratio(kind, column) for scene in scenes[kind]]
            cells.append(f"{median(ratios):.2g} ({min(ratios):.2g} to {max(ratios):.2g})")
        return [*cells, "1"]

    def a_step(kind: str, column: str) -> str:
        return f"{median(float(getattr(scene, kind)[column]) for scene in scenes[kind]):.1f}"

    passes = f"{a_step('interface', 'passes a step')} passes through fluid and wall"
    cycles = f"{a_step('block', 'passes a step')} cycles of each medium's preconditioner"
    newton = f"{a_step('monolithic', 'newton iterations a step')} Newton iterations"
    lines = [
        ["", *(f"`{kind}`" for kind in KINDS)],
        ["---"] * 4,
        ["scenes at equal error", *(str(len(scenes[kind])) for kind in KINDS)],
        ["seconds over monolithic: median (least to most)", *over("seconds at equal error")],
        ["work units over monolithic", *over("work units a step")],
        ["memory over monolithic", *over("MiB")],
        ["in a step", passes, cycles, newton],
    ]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def kinds_verdict(rows: List[Row]) -> str:
    """The answer in words: who is faster and by how much, and which scenes are left out."""
    scenes = _measured(rows, "interface")
    seconds = "seconds at equal error"
    ratios = [scene.ratio("interface", seconds) for scene in scenes]
    slower = sum(ratio > SAME for ratio in ratios)
    most = max(scenes, key=lambda scene: scene.ratio("interface", seconds))
    lines = [
        f"**Take the monolithic driver.** In {slower} of {len(scenes)} scenes the interface kind takes more seconds at equal error:",
        f"{median(ratios):.2g} times as many in the median, {max(ratios):.2g} times at most, in {_quoted([most])}.",
    ]
    faster = [scene for scene, ratio in zip(scenes, ratios) if ratio < 1 / SAME]
    equal = [scene for scene, ratio in zip(scenes, ratios) if 1 / SAME <= ratio <= SAME]
    if faster:
        lines.append(f"It takes fewer in {_quoted(faster)}.")
    if equal:
        lines.append(f"Within {100 * (SAME - 1):.0f} % the two take the same in {_quoted(equal)}.")
    apart = [scene for scene in kinds(rows) if not scene.at_equal_error("interface")]
    if apart:
        lines.append(f"Left out, since no tolerance led to the same error: {_quoted(apart)}.")
    return "\n".join(lines)


def _quoted(scenes: List[Kinds]) -> str:
    return _listed([f'"{scene.title}"' for scene in scenes])


def artery_settings(rows: List[Row]) -> str:
    """Mesh and step for an error, of the default element, and what linear elements take for nearly the same."""
    lines = []
    for by in _rungs(rows):
        one = by["monolithic"]
        element = "" if one["element"] == "p2p1" else "linear elements (`p1`): "
        seconds = ", ".join(f"{_two_digits(by[kind]['processor_s'])} s {kind}" for kind in reversed(KINDS))
        lines.append(
            f"- **{float(one['error_percent']):.2g} %**: {element}`{one['cells']}` cells, {int(one['nodes']):,} nodes, steps of "
            f"1/{1 / float(one['step_ms']):.0f} ms; {seconds}"
        )
    quadratic = [line for line in lines if "`p1`" not in line]
    return "\n".join([*quadratic, lines[-len(quadratic) - 1]])


def kinds_by_rung(rows: List[Row]) -> str:
    """Rungs of mesh and step, the kinds side by side."""
    heads = ("element", "cells", "nodes", "step, ms", "error", *(f"{kind}, s" for kind in reversed(KINDS)))
    lines = [f"| {' | '.join(heads)} |", "|" + "---|" * len(heads)]
    for by in _rungs(rows):
        one = by["monolithic"]
        errors = dict.fromkeys(f"{float(by[kind]['error_percent']):.2g} %" for kind in reversed(KINDS))
        cells = [one["element"], one["cells"], f"{int(one['nodes']):,}", f"1/{1 / float(one['step_ms']):.0f}"]
        cells += [", ".join(errors), *(_two_digits(by[kind]["processor_s"]) for kind in reversed(KINDS))]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)


def _rungs(rows: List[Row]) -> List[Dict[str, Row]]:
    """A mesh and its step by each kind."""
    found: Dict[Tuple[str, str], Dict[str, Row]] = {}
    for row in rows:
        found.setdefault((row["element"], row["cells"]), {})[row["kind"]] = row
    for (element, cells), by in found.items():
        if set(by) != set(KINDS):
            raise BlockError(f"'{element} {cells}' has not a row for each kind")
    return list(found.values())


def references_verdict(rows: List[Row]) -> str:
    """How many of the known numbers the bars hold."""
    barred = [row for row in rows if row["bar"]]
    held = [row for row in barred if _beyond(row) <= 1]
    far = max(barred, key=_beyond)
    lines = [
        f"Of {len(rows)} values, each number by each driver, {len(barred)} have an error bar. {len(held)} of these differ from the known "
        "value by no more than the bar, the spread of published values and, where these are of another model, the effect of that."
    ]
    if _beyond(far) > 1:
        lines.append(
            f"Furthest off is {far['number']} of `{far['scene']}` ({far['driver']}): {_digits(far['off'], 2)} {far['unit']}, "
            f"{_digits(far['in_bars'], 2)} bars."
        )
    return "\n".join(lines)


def references_table(rows: List[Row]) -> str:
    """A line for each number, its drivers side by side."""
    numbers: Dict[Tuple[str, str], Dict[str, Row]] = {}
    for row in rows:
        numbers.setdefault((row["scene"], row["number"]), {})[row["driver"]] = row
    heads = ["scene", "number", "unit", "known", "from", "order in mesh, step"]
    for driver in DRIVERS:
        heads += [driver, "bar", "off in bars", "s"]
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    for (scene, number), of in numbers.items():
        first = next(iter(of.values()))
        orders = ", ".join(_digits(first[name], 2) if first[name] else "-" for name in ("order_mesh", "order_step"))
        spread = f", they differ by {_digits(first['spread'], 2)} %" if first["spread"] else ""
        spread += f"; another model, worth {_digits(first['model'], 2)} %" if first["model"] else ""
        cells = [f"`{scene}`", number, first["unit"], _digits(first["known"], 6), first["source"] + spread, orders]
        for driver in DRIVERS:
            if driver not in of:
                cells += ["", "", "", ""]
                continue
            row = of[driver]
            bar = [_digits(row["bar"], 2), _digits(row["in_bars"], 2)] if row["bar"] else ["none", ""]
            cells += [_digits(row["value"], 6), *bar, _two_digits(row["seconds"])]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def peers_table(rows: List[Row]) -> str:
    """A line for each number of another program: its drivers with their bars side by side, and why they differ from it."""
    numbers: Dict[Tuple[str, str], Dict[str, Row]] = {}
    for row in rows:
        numbers.setdefault((row["scene"], row["number"]), {})[row["driver"]] = row
    heads = ["case", "peer", "number", "unit", "peer's", *DRIVERS, "difference", "why"]
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    for (scene, number), of in numbers.items():
        missing = [driver for driver in DRIVERS if driver not in of]
        if missing:
            raise BlockError(f"'{scene}' has no row of the {missing[0]} driver for '{number}'")
        first = of[DRIVERS[0]]
        cells = [f"`{scene}`", first["source"], number, first["unit"], _digits(first["known"], 5)]
        for driver in DRIVERS:
            bar = f"+- {_digits(of[driver]['bar'], 2)}" if of[driver]["bar"] else "(no bar)"
            cells.append(f"{_digits(of[driver]['value'], 5)} {bar}")
        shares = [float(row["value"]) / float(row["known"]) - 1 for row in of.values()]
        cells.append(f"{100 * max(shares, key=abs):+.2g} %")
        lines.append("| " + " | ".join([*cells, first["reason"]]) + " |")
    return "\n".join(lines)


def _beyond(row: Row) -> float:
    """What a number is off by over its bar, the spread of published values and what their model is worth."""
    share = sum(float(row[name] or 0) for name in ("spread", "model")) / 100
    return float(row["off"]) / (float(row["bar"]) + share * abs(float(row["known"])))


def _digits(number: str, digits: int) -> str:
    return f"{float(number):.{digits}g}"


def _two_digits(number: str) -> str:
    """A dash where it was not measured."""
    if not number:
        return "-"
    value = float(number)
    return f"{value:.0f}" if value >= 10 else f"{value:.2g}"


def _listed(names: List[str]) -> str:
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1]


BLOCKS: Dict[str, Callable[[List[Row]], str]] = {
    block.__name__: block
    for block in (
        kinds_verdict,
        kinds_answer,
        artery_settings,
        kinds_by_rung,
        references_verdict,
        references_table,
        peers_table,
    )
}
