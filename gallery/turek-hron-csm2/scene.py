"""Turek-Hron CSM2: a stiffer flag under its weight

The flag of CSM1, four times as stiff: it bends by a twentieth of its length.
"""

from known_solutions.turek_hron import CHANNEL, COARSE_CHANNEL, Benchmark, Known

MESH = CHANNEL
QUICK_MESH = COARSE_CHANNEL

BENCHMARK = Benchmark(Known("u_x", -0.4690), Known("u_y", -16.97), quick=1e-2, static=True)
numbers, draw = BENCHMARK.numbers, BENCHMARK.draw
