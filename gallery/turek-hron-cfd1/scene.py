"""Turek-Hron CFD1: flow around a cylinder with a rigid flag

A channel of 410 mm height with a parabolic inflow of 0.2 m/s on average; the cylinder stands a little below its middle, which
makes a lift. The Reynolds number is 20 and the flow steady, so time steps are large and of first order. The lift is the last
to become steady: after 5 s it is still 2 % off.

Drag and lift are the sums of the fluid's own residuals over the surface, which are far more accurate than integrals of
stresses. All scenes of the benchmark share one mesh; this case has no structure, so the flag is a rigid obstacle.
"""

from known_solutions.turek_hron import CHANNEL, COARSE_CHANNEL, Benchmark, Known

MESH = CHANNEL
QUICK_MESH = COARSE_CHANNEL

BENCHMARK = Benchmark(Known("drag", 14.29), Known("lift", 1.119), quick=2e-2)
numbers, draw = BENCHMARK.numbers, BENCHMARK.draw
