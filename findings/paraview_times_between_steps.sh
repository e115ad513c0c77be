#!/usr/bin/env bash
# Asked for a time between two steps of a file, ParaView's reader of XDMF gives the step before it, that of PVD the one after
# it; neither interpolates. ParaView asks all files of a scene for the same time, so fluid and wall from files of the two
# kinds, or a PVD with fewer steps than its neighbour, are shown a whole step apart. Nor need the times differ by more than
# rounding: just below a step XDMF gives the one before, just above it PVD gives the next.
# A guess would be one rule for both, the step before or the nearest, and that a rounding error does no harm.
# Seen with ParaView 5.11.0 (Debian 12). Each file has the steps 0, 1, 2 with their number as field.
# Output seen: at 0.9, 1-1e-12, 1+1e-12, 1.1: XDMF [0, 0, 1, 1], PVD [1, 1, 2, 2].
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-paraview=5.11.0+dfsg-1+b1
cat >"$scratch/12/root/times.py" <<'END'
from paraview.modules.vtkPVVTKExtensionsIOCore import vtkPVDReader
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter


def item(dimensions, kind, text):
    return f'<DataItem Dimensions="{dimensions}" NumberType="{kind}" Format="XML">{text}</DataItem>'


def grid(step):
    return (f'<Grid><Time Value="{step}"/><Topology TopologyType="Tetrahedron" NumberOfElements="1">'
            + item("1 4", "Int", "0 1 2 3") + "</Topology><Geometry>" + item("4 3", "Float", "0 0 0 1 0 0 0 1 0 0 0 1")
            + '</Geometry><Attribute Name="p" Center="Node">' + item("4", "Float", f"{step} " * 4) + "</Attribute></Grid>")


def opened(reader, name):
    reader.SetFileName("/root/" + name)
    reader.UpdateInformation()
    return reader


with open("/root/p.xdmf", "w") as file:
    series = '<Grid GridType="Collection" CollectionType="Temporal">' + "".join(map(grid, (0, 1, 2))) + "</Grid>"
    file.write('<Xdmf Version="3.0"><Domain>' + series + "</Domain></Xdmf>")

# The same steps as PVD.
xdmf = opened(vtkXdmfReader(), "p.xdmf")
with open("/root/p.pvd", "w") as file:
    file.write('<VTKFile type="Collection"><Collection>')
    for step in (0, 1, 2):
        xdmf.UpdateTimeStep(step)
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(f"/root/p{step}.vtu")
        writer.SetInputDataObject(xdmf.GetOutputDataObject(0))
        writer.Write()
        file.write(f'<DataSet timestep="{step}" file="p{step}.vtu"/>')
    file.write("</Collection></VTKFile>")

for name, reader in (("XDMF", xdmf), ("PVD", opened(vtkPVDReader(), "p.pvd"))):
    shown = []
    for time in (0.9, 1 - 1e-12, 1 + 1e-12, 1.1):
        reader.UpdateTimeStep(time)
        shown.append(int(reader.GetOutputDataObject(0).GetPointData().GetArray("p").GetValue(0)))
    print(f"at 0.9, 1-1e-12, 1+1e-12, 1.1: {name} {shown}")
END
within "$scratch/12" python3 /root/times.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "which step is given"
at 0.9, 1-1e-12, 1+1e-12, 1.1: XDMF [0, 0, 1, 1]
at 0.9, 1-1e-12, 1+1e-12, 1.1: PVD [1, 1, 2, 2]
END
