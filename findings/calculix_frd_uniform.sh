#!/usr/bin/env bash
# The nodal stresses in CalculiX's .frd file, which viewers and converters read, are not exact even where the stress is the same
# everywhere: of C3D8 and C3D8I they are 0.004 % too small, of C3D8R they are right. Where two materials meet, a node has the
# mean of both, as if they were one: the stress at the border of a wall's layers is that of neither. The .dat file (*EL PRINT)
# has the stresses of the integration points themselves.
# A guess would be that a uniform stress stays what it is, and that only elements of the same material are averaged.
# Seen with CalculiX 2.20 (Debian 12): two cubes side by side, of moduli 1 and 9, pulled to the strain 1.
# Output seen: C3D8: .dat 1 and 9, .frd 0.99996, 4.9998, 8.99964; C3D8R: .dat 1 and 9, .frd 1, 5, 9.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" calculix-ccx=2.20-1
# stresses TYPE: those along the pull in both files, each once.
stresses() {
  cat >"$scratch/12/root/two.inp" <<END
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 0, 2, 0
10, 1, 2, 0
11, 1, 2, 1
12, 0, 2, 1
*ELEMENT, TYPE=$1, ELSET=SOFT
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=$1, ELSET=STIFF
2, 4, 3, 10, 9, 8, 7, 11, 12
*ELSET, ELSET=BOTH
SOFT, STIFF
*NSET, NSET=X0
1, 4, 5, 8, 9, 12
*NSET, NSET=X1
2, 3, 6, 7, 10, 11
*NSET, NSET=Y0
1, 2, 5, 6
*NSET, NSET=Z0
1, 2, 3, 4, 9, 10
*MATERIAL, NAME=A
*ELASTIC
1., 0.
*MATERIAL, NAME=B
*ELASTIC
9., 0.
*SOLID SECTION, ELSET=SOFT, MATERIAL=A
*SOLID SECTION, ELSET=STIFF, MATERIAL=B
*BOUNDARY
X0, 1
Y0, 2
Z0, 3
*STEP
*STATIC
*BOUNDARY
X1, 1, 1, 1.
*EL FILE
S
*EL PRINT, ELSET=BOTH
S
*END STEP
END
  within "$scratch/12" sh -c 'cd /root && ccx two' >"$scratch/log" 2>&1 || fail "ccx ends with $(cat "$scratch/log")"
  ! grep -q '\*ERROR\|\*WARNING' "$scratch/log" || fail "ccx says $(cat "$scratch/log")"
  echo "$1: .dat" "$(awk 'NF == 8 && $2 ~ /^[1-8]$/ { print $3 + 0 }' "$scratch/12/root/two.dat" | sort -gu | xargs), .frd" \
    "$(awk '/^ -4/ { stress = $2 == "STRESS" } stress && /^ -1/ { print substr($0, 14, 12) + 0 }' "$scratch/12/root/two.frd" |
      sort -gu | xargs)"
}
{
  stresses C3D8
  stresses C3D8I
  stresses C3D8R
} | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "stresses"
C3D8: .dat 1 9, .frd 0.99996 4.9998 8.99964
C3D8I: .dat 1 9, .frd 0.99996 4.9998 8.99964
C3D8R: .dat 1 9, .frd 1 5 9
END
