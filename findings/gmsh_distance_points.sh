#!/usr/bin/env bash
# Gmsh's field Distance measures the distance to 20 points of a curve, not to the curve, straight lines included. A mesh that
# is to be fine along a long curve, a vessel's centre line or an edge of a stent, is fine at 20 places as on a string of
# pearls, and coarse between them, without a warning. NNodesByEdge, or NumPointsPerCurve, is the number of points; it has to be
# so large that their spacing is below the wanted length.
# A guess would be the distance to the curve, which is zero all along it, or points as dense as the mesh.
# Seen with gmsh 4.8.4 (Debian 12): a line of 100, length 0.5 at distance 0, growing to 5 at distance 2.5.
# Output seen: 93 elements with lengths from 0.54 to 3.31; with NNodesByEdge = 500 194 of 0.51 to 0.52.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" gmsh=4.8.4+ds2-3
# mesh MORE: lengths of the elements of the line, with MORE in the script.
mesh() {
  cat >"$scratch/12/root/line.geo" <<END
Point(1) = {0, 0, 0}; Point(2) = {100, 0, 0};
Line(1) = {1, 2};
Field[1] = Distance; Field[1].EdgesList = {1}; $1
Field[2] = Threshold; Field[2].IField = 1;
Field[2].LcMin = 0.5; Field[2].LcMax = 5; Field[2].DistMin = 0; Field[2].DistMax = 2.5;
Background Field = 2;
Mesh.CharacteristicLengthExtendFromBoundary = 0; Mesh.CharacteristicLengthFromPoints = 0;
END
  within "$scratch/12" gmsh -v 2 -1 -format msh2 -o /root/line.msh /root/line.geo >"$scratch/log" 2>&1 || fail "gmsh: $(cat "$scratch/log")"
  [ ! -s "$scratch/log" ] || fail "gmsh says $(cat "$scratch/log")"
  # Of format 2 only the lines of nodes have four words: number, x, y, z.
  awk 'NF == 4 { print $2 }' "$scratch/12/root/line.msh" | sort -g | awk '
    NR > 1 { step = $1 - last; if (NR == 2 || step < low) low = step; if (step > high) high = step }
    { last = $1 }
    END { printf "%d elements from %.2f to %.2f\n", NR - 1, low, high }'
}
mesh "" | tee "$scratch/said"
mesh "Field[1].NNodesByEdge = 500;" | tee -a "$scratch/said"
diff "$scratch/said" - <<'END' || fail "lengths of elements"
93 elements from 0.54 to 3.31
194 elements from 0.51 to 0.52
END
