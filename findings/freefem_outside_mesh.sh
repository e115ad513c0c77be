#!/usr/bin/env bash
# Outside its mesh a function of FreeFEM has the value of the nearest point of the mesh, and the derivative of the triangle
# there, which do not fit each other: u = x on the unit square is 1 at x = 1.5, and dx(u) is 1 as well. Nothing is said. So
# where meshes of blood and wall do not meet, or a point is given in other units, all goes on; and gradients of what is
# interpolated onto a larger mesh are not the interpolated gradients.
# A guess would be an error, as in FEniCS, zero, as by VTK's probe, or that the function is continued as its gradient says.
# Seen with FreeFEM 4.11 (Debian 12): u = x on the unit square, w is u interpolated onto a mesh from 0 to 1.5.
# Output seen: u(1.5, 0.5) = 1, dx(u)(1.5, 0.5) = 1; over the larger mesh the integrals of u and w 1, of dx(u) 1.5, of dx(w) 1.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" freefem++=4.11+dfsg1-3
cat >"$scratch/12/root/outside.edp" <<'END'
mesh Th = square(4, 4), larger = square(6, 4, [1.5 * x, y]);
fespace Vh(Th, P1);
fespace Wh(larger, P1);
Vh u = x;
Wh w = u;
cout << "at (1.5, 0.5): u " << u(1.5, 0.5) << ", dx(u) " << dx(u)(1.5, 0.5) << endl;
cout << "integrals: u " << int2d(larger)(u) << ", w " << int2d(larger)(w) << ", dx(u) " << int2d(larger)(dx(u)) << ", dx(w) "
     << int2d(larger)(dx(w)) << endl;
END
within "$scratch/12" FreeFem++-nw -v 0 /root/outside.edp >"$scratch/log" 2>&1 ||
  fail "FreeFem++ ends with $(cat "$scratch/log")"
grep -v '^ *$' "$scratch/log" | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "values outside"
at (1.5, 0.5): u 1, dx(u) 1
integrals: u 1, w 1, dx(u) 1.5, dx(w) 1
END
