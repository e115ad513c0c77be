#!/usr/bin/env bash
# A DataItem of an XDMF file can be a function of others, so that a field need not be stored: the speed, or a pressure in other
# units. VTK's reader vtkXdmfReader (ParaView: Xdmf Reader) does the sums, but leaves SQRT, ABS, EXP and SIN out, as if their
# brackets alone stood there, and turns a number minus a field, or a number by a field, round: 1 - $0 is $0 - 1, and 2 / $0 is
# $0 / 2. So SQRT($0 * $0 + $1 * $1) is the square of the speed, and 0 - $0, which is to change a sign, changes nothing. No
# warning is given. With two fields, or the number on the right, a difference and a quotient are as written. vtkXdmf3Reader
# leaves the whole field out, and says on standard error that it skips an array of an unrecognized type.
# A guess would be that a function is computed or is an error, and that a minus sign means what it does elsewhere.
# Seen with ParaView 5.11.0 and the VTK that it brings (Debian 12): $0 is 4 and $1 is 9 at all nodes.
# Output seen: $0 - 1 and 1 - $0 both 3, 0 - $0 4, $0 / 2 and 2 / $0 both 2, $1 / $0 2.25, SQRT($0) 4, SQRT($0 * $0 + $1 * $1)
# 97, ABS($0 - $1) -5, EXP($0) and SIN($0) 4; by vtkXdmf3Reader no field.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-paraview=5.11.0+dfsg-1+b1
cat >"$scratch/12/root/functions.py" <<'END'
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
from vtkmodules.vtkIOXdmf3 import vtkXdmf3Reader


def write(function):
    """One tetrahedron with the fields p = 4 and q = 9 at its nodes, and one that is this function of them."""
    numbers = '<DataItem Dimensions="4" Precision="8" Format="XML">{0} {0} {0} {0}</DataItem>'
    with open("/root/one.xdmf", "w") as file:
        file.write(f"""<?xml version="1.0"?>
<Xdmf Version="3.0"><Domain><Grid Name="one">
<Topology TopologyType="Tetrahedron" NumberOfElements="1">
<DataItem Dimensions="1 4" NumberType="Int" Format="XML">0 1 2 3</DataItem></Topology>
<Geometry GeometryType="XYZ">
<DataItem Dimensions="4 3" Precision="8" Format="XML">0 0 0 1 0 0 0 1 0 0 0 1</DataItem></Geometry>
<Attribute Name="result" AttributeType="Scalar" Center="Node">
<DataItem ItemType="Function" Function="{function}" Dimensions="4">{numbers.format(4)}{numbers.format(9)}</DataItem>
</Attribute></Grid></Domain></Xdmf>""")


def value(reader):
    reader.SetFileName("/root/one.xdmf")
    reader.Update()
    grid = reader.GetOutputDataObject(0)
    while grid.IsA("vtkCompositeDataSet"):
        grid = grid.GetBlock(0)
    array = grid.GetPointData().GetArray("result")
    return f"{array.GetValue(0):g}" if array else "no field"


FUNCTIONS = ("$0 - 1", "1 - $0", "0 - $0", "$0 / 2", "2 / $0", "$1 / $0", "SQRT($0)", "SQRT($0 * $0 + $1 * $1)",
             "ABS($0 - $1)", "EXP($0)", "SIN($0)")
for function in FUNCTIONS:
    write(function)
    print(f"{function}: Xdmf {value(vtkXdmfReader())}, Xdmf3 {value(vtkXdmf3Reader())}", flush=True)
END
within "$scratch/12" python3 /root/functions.py >"$scratch/said" 2>"$scratch/log" ||
  fail "python ends with $(cat "$scratch/log")"
sort -u "$scratch/log" >>"$scratch/said"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "the functions"
$0 - 1: Xdmf 3, Xdmf3 no field
1 - $0: Xdmf 3, Xdmf3 no field
0 - $0: Xdmf 4, Xdmf3 no field
$0 / 2: Xdmf 2, Xdmf3 no field
2 / $0: Xdmf 2, Xdmf3 no field
$1 / $0: Xdmf 2.25, Xdmf3 no field
SQRT($0): Xdmf 4, Xdmf3 no field
SQRT($0 * $0 + $1 * $1): Xdmf 97, Xdmf3 no field
ABS($0 - $1): Xdmf -5, Xdmf3 no field
EXP($0): Xdmf 4, Xdmf3 no field
SIN($0): Xdmf 4, Xdmf3 no field
Skipping unrecognized array type [None]
END
