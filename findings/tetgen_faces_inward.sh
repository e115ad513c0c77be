#!/usr/bin/env bash
# The boundary triangles that TetGen writes (.face) are turned inwards, whichever way those of the surface that it meshes are
# turned. A surface that faces outwards comes back the other way round: a pressure on the wall by these triangles pulls, and
# what leaves through the ends counts as inflow. The tetrahedra (.ele) have positive volumes.
# A guess would be the direction of the triangles that were given, or outwards.
# Seen with TetGen 1.5.0 (Debian 12): a closed tube of 12 edges around, radius 1 and length 2, whose volume by the divergence
# theorem over its triangles is 6, and -6 inside out.
# Output seen, volumes: given 6 and given -6, faces of both -6, with -p alone and with refinement by -q; tetrahedra of all 6.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" tetgen=1.5.0-5
# tube TURNED: an STL file of the tube; inside out where TURNED is 1.
tube() {
  awk -v turned="$1" '
    function corner(n) { printf "vertex %.9f %.9f %.9f\n", x[n], y[n], z[n] }
    function triangle(a, b, c) {
      print "facet normal 0 0 0\nouter loop"
      corner(a); corner(turned ? c : b); corner(turned ? b : c)
      print "endloop\nendfacet"
    }
    BEGIN {
      for (n = 0; n < 12; ++n) {
        x[n] = x[n + 12] = cos(n * atan2(0, -1) / 6); y[n] = y[n + 12] = sin(n * atan2(0, -1) / 6); z[n] = 0; z[n + 12] = 2
      }
      x[24] = y[24] = z[24] = x[25] = y[25] = 0; z[25] = 2
      print "solid tube"
      for (n = 0; n < 12; ++n) {
        next_one = (n + 1) % 12
        triangle(n, next_one, 12 + next_one); triangle(n, 12 + next_one, 12 + n)
        triangle(24, next_one, n); triangle(25, 12 + n, 12 + next_one)
      }
      print "endsolid tube"
    }'
}
# shellcheck disable=SC2016
volume='
  function determinant(a, b, c) {
    return x[a] * (y[b] * z[c] - z[b] * y[c]) - y[a] * (x[b] * z[c] - z[b] * x[c]) + z[a] * (x[b] * y[c] - y[b] * x[c])
  }'
# given FILE: the volume within the triangles of an STL file. Three vertices at a time are a triangle.
given() {
  awk "$volume"' $1 == "vertex" { x[k] = $2; y[k] = $3; z[k] = $4; if (++k == 3) { sum += determinant(0, 1, 2) / 6; k = 0 } }
    END { printf "%.3f", sum }' k=0 "$1"
}
# of FOLDER/NAME: the volume within the .face triangles, and that of the .ele tetrahedra.
of() {
  awk "$volume"' FNR == 1 { ++file; next } /^#/ { next }
    file == 1 { x[$1] = $2; y[$1] = $3; z[$1] = $4; next }
    file == 2 { faces += determinant($2, $3, $4) / 6; next }
    { tetrahedra += (determinant($3, $4, $5) - determinant($2, $4, $5)) / 6
      tetrahedra += (determinant($2, $3, $5) - determinant($2, $3, $4)) / 6 }
    END { printf "faces %.3f, tetrahedra %.3f", faces, tetrahedra }' "$1.node" "$1.face" "$1.ele"
}
for turned in 0 1; do
  for options in -pQ -pqQ; do
    tube $turned >"$scratch/12/root/tube.stl"
    within "$scratch/12" tetgen $options /root/tube.stl >"$scratch/log" 2>&1 || fail "tetgen ends with $(cat "$scratch/log")"
    echo "given $(given "$scratch/12/root/tube.stl"), $options: $(of "$scratch/12/root/tube.1")"
  done
done | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "volumes"
given 6.000, -pQ: faces -6.000, tetrahedra 6.000
given 6.000, -pqQ: faces -6.000, tetrahedra 6.000
given -6.000, -pQ: faces -6.000, tetrahedra 6.000
given -6.000, -pqQ: faces -6.000, tetrahedra 6.000
END
