#!/usr/bin/env bash
# CalculiX reads the first twenty characters of each number in a deck. Where these end within the exponent it stops with an
# error, which decks of meshio (%.16e) run into. Where they end just before the "e", as with nineteen digits, or a sign and
# eighteen, the exponent is gone without a word: 1.23 mm are 1.23 m. numpy.savetxt writes such numbers unless told otherwise
# (%.18e). With %.17e, which a C++ stream of precision 17 writes as well, negative numbers lose the exponent and positive ones
# stop the program.
# A guess would be that digits beyond those of a double are dropped, or that all that is too long is refused.
# Seen with CalculiX 2.20 (Debian 12): a block of 1.23 mm in each direction, whose volume is 1.87e-09 in m^3.
# Output seen: %.12e volume 1.87e-09; %.16e and %.17e error; %.17e of the negative number, and %.18e, 0.00187.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" calculix-ccx=2.20-1
# volume FORMAT [SIGN]: of a block from 0 to SIGN 1.23 mm in x and y, with these numbers in that format, and to 1.23 mm in z.
volume() {
  local edge
  # shellcheck disable=SC2059 # The format is the matter.
  printf -v edge "$1" "${2:-}0.0012345678901234567"
  cat >"$scratch/12/root/block.inp" <<END
*NODE
1, 0, 0, 0
2, $edge, 0, 0
3, $edge, $edge, 0
4, 0, $edge, 0
5, 0, 0, 0.00123
6, $edge, 0, 0.00123
7, $edge, $edge, 0.00123
8, 0, $edge, 0.00123
*ELEMENT, TYPE=C3D8, ELSET=BLOCK
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=X0
1, 4, 5, 8
*MATERIAL, NAME=M
*ELASTIC
3., 0.3
*SOLID SECTION, ELSET=BLOCK, MATERIAL=M
*BOUNDARY
X0, 1, 3
*STEP
*STATIC
*EL PRINT, ELSET=BLOCK
EVOL
*END STEP
END
  printf '%s, %s: ' "$1" "$edge"
  if within "$scratch/12" sh -c 'cd /root && ccx block' >"$scratch/log" 2>&1; then
    ! grep -q '\*ERROR\|\*WARNING' "$scratch/log" || fail "ccx says $(cat "$scratch/log")"
    awk 'NF == 2 && $1 == 1 { printf "volume %.3g\n", $2 }' "$scratch/12/root/block.dat"
  else
    grep -o '\*ERROR reading \*NODE' "$scratch/log" || fail "ccx ends with $(cat "$scratch/log")"
  fi
}
{
  volume %.12e
  volume %.16e
  volume %.17e
  volume %.17e -
  volume %.18e
} | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "numbers of more than twenty characters"
%.12e, 1.234567890123e-03: volume 1.87e-09
%.16e, 1.2345678901234567e-03: *ERROR reading *NODE
%.17e, 1.23456789012345670e-03: *ERROR reading *NODE
%.17e, -1.23456789012345670e-03: volume 0.00187
%.18e, 1.234567890123456700e-03: volume 0.00187
END
