#!/usr/bin/env bash
# FreeFEM's int1d(Th) integrates over all border edges of a mesh, also over those inside it, where two regions meet. The
# perimeter of blood and wall together counts the interface with it; so does the load of a weak form that names no label. With
# the normal N such an integral is not that over the boundary either: the flow out of the whole is not the integral of the
# divergence. Gluing two meshes by + leaves such edges, too. int1d(Th, 1, 2, 3, 4), by the labels of the outside, is as meant.
# A guess would be the boundary of the domain, as of `ds` of FEniCS, and of a rectangle whose perimeter is 6, 6.
# Seen with FreeFEM 4.11 (Debian 12): a rectangle of 2 x 1 with a border inside it at x = 1; (x, 0) has the flow 2.
# Output seen: all 7, by labels 6, flow 3, load 7, glued 7.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" freefem++=4.11+dfsg1-3
cat >"$scratch/12/root/perimeter.edp" <<'END'
border south(t = 0, 1) { x = t; y = 0; label = 1; }
border southeast(t = 1, 2) { x = t; y = 0; label = 1; }
border east(t = 0, 1) { x = 2; y = t; label = 2; }
border northeast(t = 2, 1) { x = t; y = 1; label = 3; }
border north(t = 1, 0) { x = t; y = 1; label = 3; }
border west(t = 1, 0) { x = 0; y = t; label = 4; }
border inner(t = 0, 1) { x = 1; y = t; label = 5; }
mesh Th = buildmesh(south(2) + southeast(2) + east(2) + northeast(2) + north(2) + west(2) + inner(2));
fespace Vh(Th, P1);
varf traction(u, v) = int1d(Th)(v);
real[int] forces = traction(0, Vh);
mesh left = square(2, 2), right = square(2, 2, [1 + x, y]), glued = left + right;
cout << "all " << int1d(Th)(1.) << ", by labels " << int1d(Th, 1, 2, 3, 4)(1.) << ", flow " << int1d(Th)(x * N.x)
     << ", load " << forces.sum << ", glued " << int1d(glued)(1.) << endl;
END
within "$scratch/12" FreeFem++-nw -v 0 /root/perimeter.edp >"$scratch/log" 2>&1 ||
  fail "FreeFem++ ends with $(cat "$scratch/log")"
grep -v '^ *$' "$scratch/log" | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "integrals"
all 7, by labels 6, flow 3, load 7, glued 7
END
