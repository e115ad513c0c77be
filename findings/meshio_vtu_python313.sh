#!/usr/bin/env bash
# meshio 5.3.5 (Debian 13, Python 3.13) cannot read VTU files whose arrays are appended in base64, which is what VTK's writer
# makes when nothing else is asked of it. The same file is read by meshio 5.0.0 of Debian 12 with Python 3.11.
# Such an array is two pieces of base64, header and numbers, each with a padding of its own. meshio hands text that begins with
# the header and goes on behind it to base64.b64decode. Up to Python 3.12 that stopped at the first padding; since 3.13 it
# goes on behind it, or raises binascii.Error.
# Output seen: 5.0.0 with 3.11.2 reads 4 points; 5.3.5 with 3.13.5 ends with binascii.Error.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-meshio=7.0.0-3
debian trixie "$scratch/13" python3-meshio=7.0.0-really-5.3.5-6+deb13u1

# One tetrahedron, with a header of eight bytes, as `header_type` says.
cat >"$scratch/write.py" <<'END'
import base64, struct

appended, offsets = "", []
def add(data):
    offsets.append(len(appended))
    return appended + base64.b64encode(struct.pack("<Q", len(data))).decode() + base64.b64encode(data).decode()
for data in (struct.pack("<12d", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1), struct.pack("<4q", 0, 1, 2, 3), struct.pack("<q", 4),
             struct.pack("<B", 10)):
    appended = add(data)
array = '<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>'
print('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64"><UnstructuredGrid>')
print('<Piece NumberOfPoints="4" NumberOfCells="1"><Points>' + array.format("Float64", "Points", 3, offsets[0]) + "</Points><Cells>")
print(array.format("Int64", "connectivity", 1, offsets[1]) + array.format("Int64", "offsets", 1, offsets[2]))
print(array.format("UInt8", "types", 1, offsets[3]) + "</Cells></Piece></UnstructuredGrid>")
print('<AppendedData encoding="base64">_' + appended + "</AppendedData></VTKFile>")
END
cat >"$scratch/read.py" <<'END'
import sys, meshio
try:
    said = f"reads {len(meshio.read('/root/one.vtu').points)} points"
except Exception as error:
    said = f"ends with {type(error).__module__}.{type(error).__name__}"
print(meshio.__version__, "with", sys.version.split()[0], said)
END
for version in 12 13; do
  cp "$scratch"/*.py "$scratch/$version/root/"
  within "$scratch/$version" sh -c "python3 /root/write.py > /root/one.vtu"
done
said=$(within "$scratch/12" python3 /root/read.py)
echo "$said"
[ "$said" = "5.0.0 with 3.11.2 reads 4 points" ] || fail "$said"
said=$(within "$scratch/13" python3 /root/read.py)
echo "$said"
[[ $said == "5.3.5 with 3.13."*" ends with binascii.Error" ]] || fail "$said"
