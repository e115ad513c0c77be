"""Turek-Hron FSI2: a heavy flag that flutters far

At a mean inflow of 1 m/s, a Reynolds number of 100, a flag ten times as dense as the fluid flutters twice a second, by
82 mm up and down: nearly half of the way to the channel's walls.

The plain harmonic mesh motion folds before the flutter is full, so another one is asked for. Published codes differ in the
amplitude of u_y by 1.2 %; here it is 1.17 % off with either driver, on a coarser mesh of channel and wake 1.5 %. Half the
time step and a tighter Newton tolerance change it by less than 0.03 %. u_x goes with the square of u_y, so that twice its
spread is allowed; the swing of u_x is 2.8 % off, which is marked.
"""

from known_solutions.turek_hron import COARSE_CHANNEL, FINE_CHANNEL, Benchmark, Known

MESH = FINE_CHANNEL
QUICK_MESH = COARSE_CHANNEL
QUICK = {"time.end": 100}
LONG = True

BENCHMARK = Benchmark(
    Known("u_x", -14.85, 12.70, tolerance=0.024),
    Known("u_y", 1.30, 81.6, tolerance=0.012, spread=0.012),
    Known("drag", 215.06, 77.65, tolerance=0.05, mean_tolerance=0.03, spread=0.05),
    Known("lift", 0.61, 237.8, tolerance=0.015, spread=0.015),
    frequency=1.93,
    frequency_tolerance=0.02,
)
numbers, draw = BENCHMARK.numbers, BENCHMARK.draw
