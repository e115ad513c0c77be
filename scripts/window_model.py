"""What different steps for fluid and wall leave, in modes of the interface: the tables of docs/coupling.md, "Different steps for fluid and wall".

A wall of the mass m_s and stiffness K moves a fluid of the mass m_f, all per area; both by the midpoint rule. The longer step has k short ones:
  fluid longer   its traction is constant over its step, the wall marches k steps under it, and the fluid meets the wall's displacement at
                 the end of its step: u_1 = 2 (d_1 - d_0)/(k dt) - u_0
  wall longer    its velocity is linear within its step, and so is the fluid's, whose momentum is then that of one step of k dt: both as long

usage: python3 scripts/window_model.py
"""

import math
import sys
from pathlib import Path
from typing import Callable, Iterator, NamedTuple, Tuple

import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / folder) for folder in ("compare", "compare/research")]

from fsi_research.evidence.bessel import bessel_i  # noqa: E402

STIFFNESS = 1.8  # kPa/mm, and masses in mg/mm^2, as fsi-partitioned states them of the paper's coarse artery
WALL, FLUID = 0.519, 0.697
RADIUS, LENGTH, DENSITY = 1.43, 18.0, 1.0  # mm, mm, mg/mm^3
PRESSURE, UNTIL = 1.332, 0.125  # kPa, ms


class Modes(NamedTuple):
    wall: float
    fluid: np.ndarray

    @property
    def frequencies(self) -> np.ndarray:  # rad/ms
        return np.sqrt(STIFFNESS / (self.wall + self.fluid))


def march(
    modes: Modes,
    displacement: np.ndarray,
    load: Callable[[float], np.ndarray],
    dt: float,
    window: Callable[[float], int],
) -> Iterator[Tuple[float, np.ndarray]]:
    """Time and displacements at the end of each step of the fluid, `window` short steps of the wall; `load` is that of its step,
    by the time at its start. From rest."""
    d, w, u = displacement, np.zeros_like(displacement), np.zeros_like(displacement)
    t = 0.0
    while True:
        k = window(t)
        length = k * dt

        def wall(traction: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
            end, velocity = d, w
            for _ in range(k):
                inertia = modes.wall / dt + STIFFNESS * dt / 4
                after = (modes.wall * velocity / dt - STIFFNESS * (end + dt * velocity / 4) + traction) / inertia
                end, velocity = end + dt * (velocity + after) / 2, after
            return end, velocity

        free, by_unit = wall(np.zeros_like(d)), wall(np.ones_like(d))
        answer = [b - a for a, b in zip(free, by_unit)]
        # m_f (u_1 - u_0)/(k dt) = load - traction
        still = modes.fluid * (2 * (free[0] - d) / length - 2 * u) / length
        traction = (load(t) - still) / (1 + 2 * modes.fluid * answer[0] / length**2)
        before, (d, w) = d, (free[0] + traction * answer[0], free[1] + traction * answer[1])
        u = 2 * (d - before) / length - u
        t += length
        yield t, d


def one_mode(wall: float, fluid: float, steps: int, k_fluid: int, k_both: int = 1) -> float:
    """Error over three periods of `steps` short steps each, let go at 1."""
    modes = Modes(wall, np.array([fluid]))
    omega = float(modes.frequencies[0])
    dt = 2 * math.pi / omega / steps * k_both
    error = size = 0.0
    for t, d in march(modes, np.ones(1), lambda t: np.zeros(1), dt, lambda t: k_fluid):
        error += (d[0] - math.cos(omega * t)) ** 2
        size += math.cos(omega * t) ** 2
        if t > 6 * math.pi / omega - 0.5 * dt:
            return math.sqrt(error / size)
    raise AssertionError("the march has no end")


def pulse(dt: float, k_fluid: int) -> float:
    """Error of the displacement along the tube at 1.5 to 6 ms."""
    numbers = np.arange(1, 121)
    waves = numbers * math.pi / LENGTH
    added = [DENSITY * bessel_i(0, m * RADIUS) / (m * bessel_i(1, m * RADIUS)) for m in waves]
    modes = Modes(WALL, np.array(added))
    shares = 2 / (numbers * math.pi) * PRESSURE  # of a pressure at the inlet, none at the outlet
    shapes = np.sin(np.outer(waves, np.linspace(0, LENGTH / 2, 91)))
    omega = modes.frequencies

    def exact(t: float) -> np.ndarray:
        return shares / STIFFNESS * (np.cos(omega * (t - UNTIL)) - np.cos(omega * t))

    def window(t: float) -> int:
        k = k_fluid
        while k > 1 and t < UNTIL - 1e-9 and t + k * dt > UNTIL + 1e-9:  # a jump of the load ends it
            k //= 2
        return k

    error = size = 0.0
    for t, d in march(modes, np.zeros_like(waves), lambda t: shares * (t < UNTIL - 1e-9), dt, window):
        if t > 6 + 1e-9:
            return math.sqrt(error / size)
        if t > 1.5 - 1e-9:
            expected = exact(t) @ shapes
            error += float(((d @ shapes - expected) ** 2).sum())
            size += float((expected**2).sum())
    raise AssertionError("the march has no end")


def main() -> None:
    print("one mode: error over that of short steps for both; wall longer is as both longer")
    for wall, fluid in ((WALL, FLUID), (0.1, 0.9), (0.9, 0.1)):
        for steps in (80, 40):
            short = one_mode(wall, fluid, steps, 1)
            both = " / ".join(f"{one_mode(wall, fluid, steps, 1, k) / short:.1f}" for k in (2, 4))
            alone = " / ".join(f"{one_mode(wall, fluid, steps, k) / short:.2f}" for k in (2, 4))
            print(f"m_s {wall:g}, m_f {fluid:g}, {steps} steps a period: both {both}, fluid alone {alone}")
    print("the paper's pulse, error in percent")
    for n in (16, 32):
        cells = [f"{100 * pulse(1 / n, k):.2f}" for k in (1, 2, 4)]
        print(
            f"steps of 1/{n} ms: fluid once, twice, four times {', '.join(cells)}; both twice {100 * pulse(2 / n, 1):.2f}"
        )


if __name__ == "__main__":
    main()
