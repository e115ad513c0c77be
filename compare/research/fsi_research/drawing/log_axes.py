"""Logarithmic axes with plain numbers: "0.1 %", "30 s", "10,000", never powers of ten."""

from typing import Sequence, Tuple

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator


def plain_number(value: float, unit: str = "") -> str:
    """The number in plain form, with its unit: 1e-05 becomes '0.00001'."""
    text = f"{float(f'{value:.6g}'):,.15f}".rstrip("0").rstrip(".")
    return f"{text} {unit}" if unit else text


def log_axes(axes: Axes, x_unit: str = "", y_unit: str = "", least: Tuple[float, float] = (4, 4)) -> None:
    """Makes both axes logarithmic, when everything is drawn. Their ends differ by `least` as ratios, so that a percent
    looks small."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(x=0.1, y=0.12)
    for axis, unit, ratio in ((axes.xaxis, x_unit, least[0]), (axes.yaxis, y_unit, least[1])):
        low, high = widened(axis.get_view_interval(), ratio)
        (axes.set_xlim if axis is axes.xaxis else axes.set_ylim)(low, high)
        plain_log_axis(axis, unit)


def plain_log_axis(axis: Axis, unit: str = "", most: int = 7) -> None:
    """Ticks at 1, 2, 5 or at powers of ten, as many as fit, for the limits as they are."""
    low, high = sorted(abs(float(end)) for end in axis.get_view_interval())
    subs: Sequence[float] = (1, 2, 3, 5, 7) if high < 12 * low else (1, 2, 5) if high < 150 * low else (1,)
    axis.set_major_locator(LogLocator(subs=subs, numticks=20 if high < 1e8 * low else most))
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain_number(value, unit)))
    axis.set_minor_locator(NullLocator())


def widened(limits: Sequence[float], factor: float) -> Tuple[float, float]:
    """The limits, moved apart about their middle where they are nearer than `factor`."""
    low, high = float(limits[0]), float(limits[1])
    middle = (low * high) ** 0.5
    return (low, high) if high >= factor * low else (middle / factor**0.5, middle * factor**0.5)
