#!/usr/bin/env bash
# In a step with NLGEOM, *ELASTIC of CalculiX is the Saint Venant-Kirchhoff material: second Piola-Kirchhoff stress by
# Green's strain. It is stiffer than Hooke's law of the logarithmic strain in tension, and in compression its stress stops
# growing at about 40 %. The stresses that it prints are Cauchy's, so nothing in the results tells. No warning is given.
# A guess would be Cauchy stress by logarithmic strain, as in Abaqus, whose decks CalculiX reads. In simple tension with E = 3,
# nu = 0.3 that is 3 ln(1.2) = 0.547 and a width of 1.2^-0.3 = 0.9468 at stretch 1.2, and 3 ln(0.6) = -1.53 at stretch 0.6.
# Seen with CalculiX 2.20 (Debian 12): one cube of edge 1, free to change its width. Green's strain gives 0.9124, 0.9317; -0.4832.
# Output seen: stretch 1.2: stress 0.9124, width 0.9317; stretch 0.6: stress -0.4832, width 1.0918.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" calculix-ccx=2.20-1
# stretched DISPLACEMENT: stress and width of the cube whose face at x = 1 has moved so far.
stretched() {
  cat >"$scratch/12/root/cube.inp" <<END
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
*ELEMENT, TYPE=C3D8, ELSET=CUBE
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=X0
1, 4, 5, 8
*NSET, NSET=X1
2, 3, 6, 7
*NSET, NSET=Y0
1, 2, 5, 6
*NSET, NSET=Z0
1, 2, 3, 4
*NSET, NSET=CORNER
7
*MATERIAL, NAME=M
*ELASTIC
3., 0.3
*SOLID SECTION, ELSET=CUBE, MATERIAL=M
*BOUNDARY
X0, 1
Y0, 2
Z0, 3
*STEP, NLGEOM
*STATIC
0.25, 1., 0.01, 0.25
*BOUNDARY
X1, 1, 1, $1
*NODE PRINT, NSET=CORNER
U
*EL PRINT, ELSET=CUBE
S
*END STEP
END
  within "$scratch/12" sh -c 'cd /root && ccx cube' >"$scratch/log" 2>&1 || fail "ccx ends with $(cat "$scratch/log")"
  if grep -i -A2 warning "$scratch/log"; then fail "a warning"; fi
  # The last lines of each kind: node 7 with its displacement, element 1 with point and stress.
  awk 'NF == 4 && $1 == 7 { width = 1 + $3 } NF == 8 && $1 == 1 { stress = $3 }
    END { printf "stress %.4f, width %.4f\n", stress, width }' "$scratch/12/root/cube.dat"
}
said="1.2: $(stretched 0.2); 0.6: $(stretched -0.4)"
echo "$said"
[ "$said" = "1.2: stress 0.9124, width 0.9317; 0.6: stress -0.4832, width 1.0918" ] || fail "$said"
