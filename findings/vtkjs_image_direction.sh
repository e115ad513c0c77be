#!/usr/bin/env bash
# vtk.js reads the Direction of a .vti file column by column, VTK writes it row by row. An image that is turned, as that of a
# scanner with tilted slices, is turned the other way round in vtk.js: a vessel that is segmented or cut there lies elsewhere.
# Nothing is said. Where axes are only mirrored the matrix is symmetric and the image is right; a test by such shows nothing.
# A guess would be one order in a format that both libraries, which are of one origin, have as their own.
# Seen with vtk.js 37.4.3 (@kitware/vtk.js, npm) and ParaView 5.11.0 (Debian 12): axes turned by 30 degrees about z, origin 0.
# Output seen, place of the voxel (2, 0, 0): VTK (1.732, 1, 0), vtk.js (1.732, -1, 0); mirrored x and y: both (-2, 0, 0).
# Needs Node.js and npm.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

npm install --silent --no-audit --no-fund --omit=peer --prefix "$scratch" @kitware/vtk.js@37.4.3 || {
  echo "${0##*/}: cannot install @kitware/vtk.js 37.4.3" >&2
  exit 2
}
debian bookworm "$scratch/12" python3-paraview=5.11.0+dfsg-1+b1
cat >"$scratch/12/root/write.py" <<'END'
from math import cos, pi, sin
from vtkmodules.vtkCommonCore import VTK_UNSIGNED_CHAR
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter

c, s = cos(pi / 6), sin(pi / 6)
# The columns of the matrix are the directions of the axes.
for name, rows in (("turned", (c, -s, 0, s, c, 0, 0, 0, 1)), ("mirrored", (-1, 0, 0, 0, -1, 0, 0, 0, 1))):
    image, writer, reader = vtkImageData(), vtkXMLImageDataWriter(), vtkXMLImageDataReader()
    image.SetDimensions(3, 3, 3)
    image.SetDirectionMatrix(*rows)
    image.AllocateScalars(VTK_UNSIGNED_CHAR, 1)
    writer.SetInputData(image)
    writer.SetFileName(f"/root/{name}.vti")
    writer.SetDataModeToAscii()
    writer.Write()
    reader.SetFileName(f"/root/{name}.vti")
    reader.Update()
    print(f"{name}: VTK", *(round(number, 3) + 0 for number in reader.GetOutput().GetPoint(2)))
END
cat >"$scratch/read.mjs" <<'END'
import fs from "fs";
import Reader from "@kitware/vtk.js/IO/XML/XMLImageDataReader.js";

for (const name of ["turned", "mirrored"]) {
  const reader = Reader.newInstance();
  reader.parseAsArrayBuffer(new Uint8Array(fs.readFileSync(`${process.argv[2]}/${name}.vti`)).buffer);
  const place = reader.getOutputData(0).indexToWorld([2, 0, 0]);
  console.log(`${name}: vtk.js`, ...Array.from(place, (number) => (Math.round(number * 1000) / 1000 + 0).toFixed(3)));
}
END
within "$scratch/12" python3 /root/write.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
node "$scratch/read.mjs" "$scratch/12/root" >>"$scratch/said" 2>"$scratch/log" || fail "node ends with $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "where the voxel is"
turned: VTK 1.732 1.0 0.0
mirrored: VTK -2.0 0.0 0.0
turned: vtk.js 1.732 -1.000 0.000
mirrored: vtk.js -2.000 0.000 0.000
END
