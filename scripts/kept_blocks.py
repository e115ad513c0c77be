"""What pages say of kept tables beyond the tables themselves: blocks of text that scripts/kept_pages.py puts on them."""

from statistics import median
from typing import Callable, Dict, List, NamedTuple, Optional, Tuple

from kept_tables import Row

DRIVERS = ("monolithic", "partitioned")
LOOSE = "partitioned 0.0001"
SAME = 1.1  # ratios of seconds nearer to 1 than this, either way, are no difference: the scatter of short runs


class BlockError(Exception):
    """A table that a block cannot be made of."""


class Pair(NamedTuple):
    """A case by both drivers."""

    monolithic: Row
    partitioned: Row
    loose: Optional[Row]  # the partitioned driver with a tolerance of 1e-4

    @property
    def title(self) -> str:
        return self.monolithic["title"].split(":")[0].removeprefix("Turek-Hron ")

    @property
    def coupled(self) -> bool:
        """Whether there are two media: the partitioned driver has a scheme then."""
        return self.partitioned["scheme"] != ""

    def ratio(self, column: str) -> float:
        """Partitioned over monolithic."""
        return float(self.partitioned[column]) / float(self.monolithic[column])


def pairs(rows: List[Row]) -> List[Pair]:
    """By rising ratio of seconds."""
    found: Dict[str, Dict[str, Row]] = {}
    for row in rows:
        found.setdefault(row["case"], {})[row["driver"]] = row
    for case, both in found.items():
        if not set(DRIVERS) <= set(both) <= {*DRIVERS, LOOSE}:
            raise BlockError(f"'{case}' has not a row for each driver")
    cases = [Pair(both[DRIVERS[0]], both[DRIVERS[1]], both.get(LOOSE)) for both in found.values()]
    return sorted(cases, key=lambda pair: pair.ratio("processor_s"))


def drivers_verdict(rows: List[Row]) -> str:
    """The answer in words: who is faster, by how much, who needs less memory."""
    coupled = [pair for pair in pairs(rows) if pair.coupled]
    ratios = [pair.ratio("processor_s") for pair in coupled]
    slower = sum(ratio > SAME for ratio in ratios)
    faster = [pair.title for pair, ratio in zip(coupled, ratios) if ratio < 1 / SAME]
    equal = [pair.title for pair, ratio in zip(coupled, ratios) if 1 / SAME <= ratio <= SAME]
    memory = max(coupled, key=lambda pair: float(pair.monolithic["memory_MiB"] or 0))
    gibibytes = [f"{float(row['memory_MiB']) / 1024:.2f}" for row in (memory.partitioned, memory.monolithic)]
    lines = [
        f"**Take the monolithic driver.** In {slower} of {len(coupled)} cases with fluid and wall the partitioned one takes more seconds:",
        f"{median(ratios):.2g} times as many in the median, {max(ratios):.2g} times at most, in {coupled[-1].title}.",
    ]
    if faster:
        lines.append(f"It takes fewer in {_listed(faster)}.")
    if equal:
        lines.append(f"Within {100 * (SAME - 1):.0f} % the two take the same in {_listed(equal)}.")
    lines += [
        "",
        f"**Take the partitioned driver where memory is short.** In the largest run, {memory.title}, it needs {gibibytes[0]} GiB, the "
        f"monolithic one {gibibytes[1]}.",
    ]
    return "\n".join(lines)


def drivers_table(rows: List[Row]) -> str:
    """Cases with two media, by rising ratio; those with one medium in one line."""
    columns = (
        "case",
        "steps",
        "monolithic: s",
        "MiB",
        "Newton iterations a step",
        "partitioned: s",
        "MiB",
        "passes a step",
        "the same at 1e-4",
        "**ratio of seconds**",
        "**of memory**",
        "furthest off what is known",
    )
    lines: List[List[str]] = [list(columns), ["---"] * len(columns)]
    for pair in pairs(rows):
        if pair.coupled:
            cells = [pair.title, pair.monolithic["steps"]]
            cells += [_seconds(pair.monolithic), pair.monolithic["memory_MiB"]]
            cells += [_a_step(pair.monolithic, "newton_iterations")]
            cells += [_seconds(pair.partitioned), pair.partitioned["memory_MiB"], _a_step(pair.partitioned, "passes")]
            cells += [_a_step(pair.loose, "passes") if pair.loose else "", f"**{pair.ratio('processor_s'):.2g}**"]
            known = all(row["memory_MiB"] for row in (pair.monolithic, pair.partitioned))
            cells += [f"**{pair.ratio('memory_MiB'):.2f}**" if known else "", _errors(pair)]
            lines.append(cells)
    single = [pair for pair in pairs(rows) if not pair.coupled]
    if single:
        ratios = [
            [pair.ratio(name) for pair in single if pair.monolithic[name]] for name in ("processor_s", "memory_MiB")
        ]
        names = _listed(sorted(pair.title for pair in single))
        shown = [f"{min(values):.2f} to {max(values):.2f}" for values in ratios]
        lines.append([f"one medium: {names}", *[""] * 8, shown[0], shown[1], ""])
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def drivers_why(rows: List[Row]) -> str:
    """What goes with the ratio: how many more iterations, and what each costs."""
    # block-newton counts Newton's iterations of both media together: as many as the monolithic driver.
    counted = [
        pair
        for pair in pairs(rows)
        if pair.coupled and pair.partitioned["newton_iterations"] and pair.partitioned["scheme"] != "block-newton"
    ]
    more = {pair.title: pair.ratio("newton_iterations") for pair in counted}
    cost = [pair.ratio("processor_s") / more[pair.title] for pair in counted]
    most = max(counted, key=lambda pair: more[pair.title])
    return (
        f"**Why.** Every pass of an interface scheme solves fluid and wall anew. So the partitioned driver makes {min(more.values()):.1f} to "
        f"{max(more.values()):.0f} times as many\nNewton iterations, of one medium each, and such an iteration takes {min(cost):.2f} to "
        f"{max(cost):.2f} of the seconds of a coupled one. The\nfirst number decides: it is highest in {most.title}, with "
        f"{_a_step(most.partitioned, 'passes')} passes a step."
    )


def artery_settings(rows: List[Row]) -> str:
    """Mesh and step for an error, of the default element, and what linear elements take for nearly the same."""
    lines = []
    for one, other in zip(*([row for row in rows if row["driver"] == driver] for driver in DRIVERS)):
        element = "" if one["element"] == "p2p1" else "linear elements (`p1`): "
        lines.append(
            f"- **{float(one['error_percent']):.2g} %**: {element}`{one['cells']}` cells, {int(one['nodes']):,} nodes, steps of "
            f"1/{1 / float(one['step_ms']):.0f} ms; {_two_digits(one['processor_s'])} s monolithic, "
            f"{_two_digits(other['processor_s'])} s partitioned"
        )
    quadratic = [line for line in lines if "`p1`" not in line]
    return "\n".join([*quadratic, lines[-len(quadratic) - 1]])


def both_drivers(rows: List[Row]) -> str:
    """Rungs of mesh and step, the drivers side by side."""
    rungs: Dict[Tuple[str, str], Dict[str, Row]] = {}
    for row in rows:
        rungs.setdefault((row["element"], row["cells"]), {})[row["driver"]] = row
    lines = [
        "| element | cells | nodes | step, ms | error | monolithic, s | partitioned, s |",
        "|---|---|---|---|---|---|---|",
    ]
    for (element, cells), both in rungs.items():
        one, other = (both[driver] for driver in DRIVERS)
        step = f"1/{1 / float(one['step_ms']):.0f}"
        error = f"{float(one['error_percent']):.2g} %"
        seconds = [_two_digits(row["processor_s"]) for row in (one, other)]
        lines.append(
            f"| {element} | {cells} | {int(one['nodes']):,} | {step} | {error} | {seconds[0]} | {seconds[1]} |"
        )
    return "\n".join(lines)


def references_verdict(rows: List[Row]) -> str:
    """How many of the known numbers the bars hold."""
    barred = [row for row in rows if row["bar"]]
    held = [row for row in barred if _beyond(row) <= 1]
    far = max(barred, key=_beyond)
    lines = [
        f"{len(barred)} of {len(rows)} numbers, each by each driver, have a bar. {len(held)} of these differ from the known value by no "
        "more than their bar, what published values differ by among each other and, where these are of another model, what that is worth."
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


def _beyond(row: Row) -> float:
    """What a number is off by over its bar, the spread of published values and what their model is worth."""
    share = sum(float(row[name] or 0) for name in ("spread", "model")) / 100
    return float(row["off"]) / (float(row["bar"]) + share * abs(float(row["known"])))


def _digits(number: str, digits: int) -> str:
    return f"{float(number):.{digits}g}"


def _a_step(row: Row, column: str) -> str:
    return f"{float(row[column]) / float(row['steps']):.1f}"


def _seconds(row: Row) -> str:
    value = float(row["processor_s"])
    return f"{value:.1f}" if value < 10 else f"{value:,.0f}"


def _errors(pair: Pair) -> str:
    """Monolithic and partitioned; one number where they are the same."""
    shown = [f"{row['error_percent']} %" for row in (pair.monolithic, pair.partitioned) if row["error_percent"]]
    return ", ".join(dict.fromkeys(shown))


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
        drivers_verdict,
        drivers_table,
        drivers_why,
        artery_settings,
        both_drivers,
        references_verdict,
        references_table,
    )
}
