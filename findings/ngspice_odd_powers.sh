#!/usr/bin/env bash
# A power of a negative number is that of its absolute value in ngspice's circuits: where v(in) is -2, v(in)^3, v(in)**3 and
# pow(v(in), 3) of a source are 8, and so is (-2)^3 of a .param line. A resistance that grows with the cube of the flow is right
# forwards, and drives the wrong way as soon as the flow turns back. The commands between .control and .endc have -8 for the
# same words, so a check of the formula there shows nothing. No warning. A product, or pwr(v(in), 3), has the sign.
# A guess would be -8, as in C, in a spreadsheet, and between .control and .endc.
# Seen with ngspice 39.3 (Debian 12): a source of -2; and a vessel of compliance 1 at pressure -1, emptied by the flow p^3, of
# which the pressure at time 0.2 is -1 / sqrt(1.4) = -0.845.
# Output seen: ^, **, pow() and .param 8; product, pwr() and .control -8; pressure by ^ -1.29, by the product -0.85.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" ngspice=39.3+ds-1
cat >"$scratch/12/root/power.cir" <<'END'
odd powers
.param raised = {(-2)^3}
v1 in 0 -2
b1 caret 0 v = v(in)^3
b2 stars 0 v = v(in)**3
b3 pow 0 v = pow(v(in), 3)
v2 param 0 {raised}
b4 product 0 v = v(in)*v(in)*v(in)
b5 pwr 0 v = pwr(v(in), 3)
.control
op
let control = v(in)^3
print v(caret) v(stars) v(pow) v(param) v(product) v(pwr) control
quit
.endc
.end
END
cat >"$scratch/12/root/vessel.cir" <<'END'
two vessels that empty
c1 by_caret 0 1 ic=-1
b1 by_caret 0 i = v(by_caret)^3
c2 by_product 0 1 ic=-1
b2 by_product 0 i = v(by_product)*v(by_product)*v(by_product)
.tran 1m 0.2 uic
.meas tran caret find v(by_caret) at=0.2
.meas tran product find v(by_product) at=0.2
.end
END
for circuit in power vessel; do
  within "$scratch/12" ngspice -b "/root/$circuit.cir" >>"$scratch/log" 2>&1 || fail "ngspice ends with $(cat "$scratch/log")"
done
awk '$2 == "=" && $1 ~ /^(v\(.*\)|control)$/ { print $1, $3 + 0 }
  $2 == "=" && /^(caret|product) / { printf "vessel %s %.2f\n", $1, $3 }' "$scratch/log" | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the powers"
v(caret) 8
v(stars) 8
v(pow) 8
v(param) 8
v(product) -8
v(pwr) -8
control -8
vessel caret -1.29
vessel product -0.85
END
