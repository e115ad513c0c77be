"""Turek-Hron CFD2: faster flow around a cylinder with a rigid flag

CFD1 at five times the speed, 1 m/s on average. The Reynolds number is 100 and the flow still steady.
"""

from known_solutions.turek_hron import CHANNEL, COARSE_CHANNEL, Benchmark, Known

MESH = CHANNEL
QUICK_MESH = COARSE_CHANNEL

BENCHMARK = Benchmark(Known("drag", 136.7), Known("lift", 10.53), quick=0.1)
numbers, draw = BENCHMARK.numbers, BENCHMARK.draw
