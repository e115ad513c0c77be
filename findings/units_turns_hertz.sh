#!/usr/bin/env bash
# A pump that turns 3000 times a minute makes 50 turns a second. Pint, GNU units and UDUNITS, asked for 3000 rpm in Hz,
# say 314. To them a turn is the number 2 pi, as an angle in radians, and Hz is 1/s, so what they give is the angular
# frequency. Likewise 50 turn/s are 314 Hz, and 50 Hz in rpm 477. Nothing is said. The period by 1 / f is 3 ms in place
# of 20. Astropy refuses. 3000 1/min, without turns, are 50 Hz in all four.
# A guess would be 50, since hertz are cycles per second, or an error, since a speed of rotation is no frequency.
# Seen with Pint 0.19.2, GNU units 2.22, UDUNITS 2.2.28 and Astropy 5.2.1 (Debian 12). Astropy calls a turn cycle.
# Output seen, of Pint, units and UDUNITS alike: 3000 rpm and 50 turn/s 314.159 Hz, 3000 1/min 50 Hz, 50 Hz 477.465 rpm;
# Astropy: UnitConversionError, but for 3000 1/min, 50 Hz.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-pint=0.19.2-1 units=2.22-2 udunits-bin=2.2.28-5 python3-astropy=5.2.1-2+deb12u1
cat >"$scratch/12/root/turns.py" <<'END'
import subprocess

import astropy.units
import pint

registry = pint.UnitRegistry()


def by_pint(value, unit, wanted):
    return registry.Quantity(value, unit).to(wanted).magnitude


def by_units(value, unit, wanted):
    words = ["units", "--terse", f"{value} {unit}", wanted]
    return float(subprocess.run(words, check=True, capture_output=True, text=True).stdout)


def by_udunits(value, unit, wanted):
    words = ["udunits2", "-H", f"{value} {unit}", "-W", wanted]
    said = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    return float(said.split("=")[1].split()[0])


def by_astropy(value, unit, wanted):
    unit, wanted = (word.replace("rpm", "turn/min").replace("turn", "cycle") for word in (unit, wanted))
    return astropy.units.Quantity(value, unit).to_value(wanted)


programs = {"Pint": by_pint, "units": by_units, "UDUNITS": by_udunits, "Astropy": by_astropy}
for question in ((3000, "rpm", "Hz"), (50, "turn/s", "Hz"), (3000, "1/min", "Hz"), (50, "Hz", "rpm")):
    answers = []
    for name, convert in programs.items():
        try:
            answers.append(f"{name} {convert(*question):.6g}")
        except astropy.units.UnitConversionError:
            answers.append(f"{name} UnitConversionError")
    print("{} {} in {}: ".format(*question) + ", ".join(answers))
END
within "$scratch/12" python3 /root/turns.py >"$scratch/said" 2>"$scratch/log" ||
  fail "python ends with $(cat "$scratch/log")"
[ ! -s "$scratch/log" ] || fail "python says $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the conversions"
3000 rpm in Hz: Pint 314.159, units 314.159, UDUNITS 314.159, Astropy UnitConversionError
50 turn/s in Hz: Pint 314.159, units 314.159, UDUNITS 314.159, Astropy UnitConversionError
3000 1/min in Hz: Pint 50, units 50, UDUNITS 50, Astropy 50
50 Hz in rpm: Pint 477.465, units 477.465, UDUNITS 477.465, Astropy UnitConversionError
END
