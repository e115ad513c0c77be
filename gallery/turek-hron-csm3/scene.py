"""Turek-Hron CSM3: an elastic flag that swings under its weight

The flag of CSM1, at rest until gravity begins to act. Nothing damps it, so it swings for ever, a little more than once a
second. The scheme is the midpoint rule without its shift, which keeps the energy.

The second mode swings along, nearly six times as often, and beats with the first one: the extremes of a period go up and
down from period to period, and how fast depends on the time step, 5 ms here as in the publication. What is published is
read off the tenth second, and so is this.
"""

from known_solutions.turek_hron import CHANNEL, COARSE_CHANNEL, Benchmark, Known

MESH = CHANNEL
QUICK_MESH = COARSE_CHANNEL

BENCHMARK = Benchmark(
    Known("u_x", -14.305, 14.305), Known("u_y", -63.607, 65.160), frequency=1.0995, window=2, quick=1e-2
)
numbers, draw = BENCHMARK.numbers, BENCHMARK.draw
