#!/usr/bin/env python3
"""reference_errors.py REFERENCE.csv RUN...: relative L2 error of the centre-line pressure of runs against a reference with the
same columns, at the paper's times, and the speed of the crest between 4.5 and 9 ms."""

import sys

import numpy

TIMES = (1.5, 3, 4.5, 6, 7.5, 9)


def load(path):
    rows = numpy.genfromtxt(path, delimiter=",", skip_header=1)
    times = numpy.unique(rows[:, 0])
    points = len(rows) // len(times)
    return times, rows[:points, 1], rows[:, 2].reshape(len(times), points)


def crest(z, p):
    k = int(p[1:-1].argmax()) + 1
    curvature = p[k - 1] - 2 * p[k] + p[k + 1]
    shift = 0.5 * (p[k - 1] - p[k + 1]) / curvature if curvature < 0 else 0.0
    return z[k] + shift * (z[1] - z[0])


def speed(times, z, p):
    chosen = (times > 4.5 - 1e-6) & (times < 9 + 1e-6)
    return numpy.polyfit(times[chosen], [crest(z, q) for q in p[chosen]], 1)[0]


def main(reference, runs):
    t0, z0, p0 = load(reference)
    print(f"{'run':<44} {'crest mm/ms':>11}   relative L2 error at t = {', '.join(map(str, TIMES))} ms")
    print(f"{reference:<44} {speed(t0, z0, p0):11.3f}")
    for run in runs:
        t, z, p = load(f"{run}/centerline_pressure.csv")
        errors = []
        for time in TIMES:
            exact = p0[abs(t0 - time).argmin()]
            errors.append(numpy.linalg.norm(p[abs(t - time).argmin()] - exact) / numpy.linalg.norm(exact))
        print(f"{run:<44} {speed(t, z, p):11.3f}   {' '.join(f'{e:5.2f}' for e in errors)}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("usage: reference_errors.py REFERENCE.csv RUN...")
    main(sys.argv[1], sys.argv[2:])
