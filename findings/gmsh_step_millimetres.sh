#!/usr/bin/env bash
# gmsh's own models have no unit, its STEP files have: all that it writes is said to be in millimetres, and all that it reads is
# turned into millimetres. A vessel modelled in metres, saved as STEP, is 1000 times too small for every other program, and gmsh
# itself shows nothing, since it reads the file back as it was. A file in metres comes in 1000 times as large as its numbers.
# Geometry.OCCTargetUnit = "M" corrects that, and makes gmsh's own files 1000 times too small. BREP files have no unit.
# A guess would be that numbers go in and out as they are, or that a file which was written says what was meant.
# Seen with gmsh 4.8.4 (Debian 12): a cylinder of length 0.01.
# Output seen, lengths: written SI_UNIT(.MILLI.,.METRE.); read back 1e-02, with "M" 1e-05; the same file, changed to say metres,
# 1e+01, with "M" 1e-02.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" gmsh=4.8.4+ds2-3
cat >"$scratch/12/root/vessel.geo" <<'END'
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 0.01, 0.003};
END
within "$scratch/12" gmsh -v 2 -0 -o /root/vessel.step /root/vessel.geo >"$scratch/log" 2>&1 ||
  fail "gmsh ends with $(cat "$scratch/log")"
sed 's/SI_UNIT(\.MILLI\.,\.METRE\.)/SI_UNIT($,.METRE.)/' "$scratch/12/root/vessel.step" >"$scratch/12/root/metres.step"
# length NAME UNIT: the z of the upper end, as read from that file with that Geometry.OCCTargetUnit.
length() {
  cat >"$scratch/12/root/read.geo" <<END
SetFactory("OpenCASCADE");
Geometry.OCCTargetUnit = "$2";
Merge "/root/$1.step";
box() = BoundingBox Volume{1};
Printf("%.0e", box(5)) > "/root/length";
END
  within "$scratch/12" gmsh -v 2 -0 /root/read.geo >"$scratch/log" 2>&1 || fail "gmsh ends with $(cat "$scratch/log")"
  cat "$scratch/12/root/length"
}
{
  echo "written: $(grep -o 'SI_UNIT([^)]*METRE\.)' "$scratch/12/root/vessel.step")"
  for name in vessel metres; do
    echo "$name: length $(length $name ""), with \"M\" $(length $name M)"
  done
} | tee "$scratch/said"
diff "$scratch/said" - <<'END' || fail "lengths"
written: SI_UNIT(.MILLI.,.METRE.)
vessel: length 1e-02, with "M" 1e-05
metres: length 1e+01, with "M" 1e-02
END
