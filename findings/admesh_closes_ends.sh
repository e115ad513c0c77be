#!/usr/bin/env bash
# ADMesh, told only to scale an STL file, or to write it as binary, closes its holes as well: the open ends of a vessel get lids of
# triangles across them, and inlet and outlet are wall. Without any other option it makes all its checks and repairs, of
# which the filling of holes is one; one line of its report counts the facets added. --no-check leaves the surface as it is,
# and so does naming a check, such as --exact.
# A guess would be that a file comes out with the triangles that went in, or that a repair has to be asked for by --fill-holes.
# Seen with ADMesh 0.98.4 (Debian 12): a tube of 192 triangles, open at both ends, scaled from m to mm.
# Output seen: 236 triangles, of which 44 in the planes of the ends; with --no-check, and with --exact, 192 and 0.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" admesh=0.98.4-2
awk 'function corner(k, i) { return sprintf("vertex %.9g %.9g %.9g\n", 0.003 * cos(i * turn), 0.003 * sin(i * turn), 0.01 * k) }
  function facet(a, b, c) { printf "facet normal 0 0 0\nouter loop\n%s%s%sendloop\nendfacet\n", a, b, c }
  BEGIN {
    turn = atan2(0, -1) / 12
    print "solid tube"
    for (k = 0; k < 4; ++k)
      for (i = 0; i < 24; ++i) {
        facet(corner(k, i), corner(k, (i + 1) % 24), corner(k + 1, (i + 1) % 24))
        facet(corner(k, i), corner(k + 1, (i + 1) % 24), corner(k + 1, i))
      }
    print "endsolid tube"
  }' >"$scratch/12/root/tube.stl"
# scaled OPTION...: triangles of the tube in mm, and those of them with all corners in the plane of an end.
scaled() {
  within "$scratch/12" admesh --scale=1000 "$@" --write-ascii-stl=/root/mm.stl /root/tube.stl >"$scratch/log" 2>&1 ||
    fail "admesh ends with $(cat "$scratch/log")"
  awk '$1 == "vertex" { low += $4 < 1e-3; high += $4 > 40 - 1e-3 }
    $1 == "endfacet" { ++all; flat += low == 3 || high == 3; low = high = 0 }
    END { printf "%d triangles, %d across the ends\n", all, flat }' "$scratch/12/root/mm.stl"
}
{
  echo "scaled: $(scaled)"
  echo "--no-check: $(scaled --no-check)"
  echo "--exact: $(scaled --exact)"
} | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "what ADMesh writes"
scaled: 236 triangles, 44 across the ends
--no-check: 192 triangles, 0 across the ends
--exact: 192 triangles, 0 across the ends
END
