#!/usr/bin/env bash
# splprep of SciPy, which lays a spline through points in space such as those of a vessel's centre line, misses them
# unless s = 0 is said. Without s the sum of the squared distances may be about the number of points, in whatever unit
# the points have. Of a bent vessel in millimetres the spline is off by millimetres; in metres it is a single cubic,
# which leaves the vessel; in micrometres it is within 2 of them. Tangents, curvature and length are those of the other
# curve. Nothing is said. splrep, its sister for one coordinate, goes through all points where no s is given, and
# documents that; of splprep no default is documented.
# A guess would be a spline through the points, as by splrep, or at least the same curve in each unit.
# The same in 1.10.1 (Debian 12) and 1.15.3 (Debian 13): 50 points on two turns of a helix, of radius 10 and length 200
# mm.
# Output seen: splprep: um: misses points by 0.0016 mm; mm: by 1.9 mm, length 200 mm; m: one cubic, by 12 mm, length 159
# mm; with s = 0, and by splrep, through all points in each unit.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-scipy=1.10.1-2
debian trixie "$scratch/13" python3-scipy=1.15.3-1
for root in 12 13; do
  cat >"$scratch/$root/root/line.py" <<'END'
import numpy
import scipy
from scipy.interpolate import splev, splprep, splrep

print(f"SciPy {scipy.__version__}")
u = numpy.linspace(0, 1, 50)
# In millimetres: two turns of a helix of radius 10, of which each has the length 100.
angle = 4 * numpy.pi * u
points = numpy.array([10 * numpy.cos(angle), 10 * numpy.sin(angle), 2 * (100**2 - (20 * numpy.pi) ** 2) ** 0.5 * u])
fine = numpy.linspace(0, 1, 10001)


def length(line):
    return numpy.linalg.norm(numpy.diff(line), axis=0).sum()


def show(name, at_points, between, unit, knots):
    missed = numpy.linalg.norm(at_points / unit - points, axis=0).max()
    missed = f"misses points by {missed:.2g} mm" if missed > 1e-9 else "through all points"
    print(f"{name}: {missed}, length {length(between / unit):.0f} mm, cubics: {knots - 7}")


for name, unit in (("um", 1000), ("mm", 1), ("m", 0.001)):
    for smoothing in ({}, {"s": 0}):
        spline, parameters = splprep(points * unit, **smoothing)
        words = f"splprep, {name}" + (", s = 0" if smoothing else "")
        show(words, numpy.array(splev(parameters, spline)), numpy.array(splev(fine, spline)), unit, len(spline[0]))
    splines = [splrep(u, coordinate * unit) for coordinate in points]
    at, between = (numpy.array([splev(where, spline) for spline in splines]) for where in (u, fine))
    show(f"splrep, {name}", at, between, unit, len(splines[0][0]))
END
  within "$scratch/$root" python3 /root/line.py >"$scratch/$root/said" 2>"$scratch/log" ||
    fail "python ends with $(cat "$scratch/log")"
  [ ! -s "$scratch/log" ] || fail "python says $(cat "$scratch/log")"
  cat "$scratch/$root/said"
done
expected() {
  cat <<END
SciPy $1
splprep, um: misses points by 0.0016 mm, length 201 mm, cubics: 39
splprep, um, s = 0: through all points, length 200 mm, cubics: 47
splrep, um: through all points, length 200 mm, cubics: 47
splprep, mm: misses points by 1.9 mm, length 200 mm, cubics: 7
splprep, mm, s = 0: through all points, length 200 mm, cubics: 47
splrep, mm: through all points, length 200 mm, cubics: 47
splprep, m: misses points by 12 mm, length 159 mm, cubics: 1
splprep, m, s = 0: through all points, length 200 mm, cubics: 47
splrep, m: through all points, length 200 mm, cubics: 47
END
}
expected 1.10.1 | diff "$scratch/12/said" - || fail "the splines of 1.10.1"
expected 1.15.3 | diff "$scratch/13/said" - || fail "the splines of 1.15.3"
