"""Turek-Hron CSM1: an elastic flag under its weight

The flag of Turek's and Hron's benchmark, 350 mm long and 20 mm thick, hangs from the rigid cylinder and bends under gravity
by a fifth of its length. Its material is Saint Venant's and Kirchhoff's. There is no fluid.

All scenes of the benchmark share one mesh: volumes and surfaces that a case does not name are left out.
"""

from known_solutions.turek_hron import CHANNEL, COARSE_CHANNEL, Benchmark, Known

MESH = CHANNEL
QUICK_MESH = COARSE_CHANNEL

BENCHMARK = Benchmark(Known("u_x", -7.187), Known("u_y", -66.10), quick=1e-2, static=True)
numbers, draw = BENCHMARK.numbers, BENCHMARK.draw
