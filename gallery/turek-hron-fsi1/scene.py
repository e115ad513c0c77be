"""Turek-Hron FSI1: flow around a cylinder with an elastic flag

The flow of CFD1 with the flag of CSM1: it bends a little and comes to rest. Both drivers march to the steady state with
large steps of first order; the two solve for one and the same state.

The benchmark's tip displacement is 0.82 mm across a channel of 410 mm, so it asks for accurate forces and for an accurate
wall at once.
"""

from known_solutions.turek_hron import CHANNEL, COARSE_CHANNEL, Benchmark, Known

MESH = CHANNEL
QUICK_MESH = COARSE_CHANNEL
QUICK = {"time.end": 5000}

DRAG = 14.29426
BENCHMARK = Benchmark(
    Known("u_x", 0.02270493),
    Known("u_y", 0.8208773),
    Known("drag", DRAG),
    Known("lift", 0.763746, scale=DRAG),
    quick=0.1,
)
numbers, draw = BENCHMARK.numbers, BENCHMARK.draw
