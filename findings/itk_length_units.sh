#!/usr/bin/env bash
# ITK turns the lengths of a NIfTI file into millimetres, by the unit in its header, and takes those of NRRD and MetaImage
# files as they are, although these can name a unit as well ("space units", DistanceUnits). Of one image in micrometres, as of a
# vessel by micro-CT, the NIfTI file is 1000 times smaller than the other two. Nothing is said. In mm all three are alike, so a
# test by such shows nothing.
# A guess would be that ITK, whose images have no unit, never looks at one, or that it does in each format that has one.
# Seen with the ITK of @itk-wasm/image-io 1.6.1 (npm): spacing 5, 6, 7, origin 10, 20, 30.
# Output seen, spacing of NIfTI, NRRD, MetaImage: mm 5 6 7, 5 6 7, 5 6 7; um 0.005 0.006 0.007, 5 6 7, 5 6 7.
# Needs Node.js and npm.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

npm install --silent --no-audit --no-fund --prefix "$scratch" @itk-wasm/image-io@1.6.1 itk-wasm@1.0.0-b.201 || {
  echo "${0##*/}: cannot install @itk-wasm/image-io 1.6.1" >&2
  exit 2
}
cat >"$scratch/units.mjs" <<'END'
import fs from "fs";
import path from "path";
import { fileURLToPath } from "url";
import { readImageNode } from "@itk-wasm/image-io";

const folder = path.dirname(fileURLToPath(import.meta.url));
const voxels = Buffer.alloc(24);

function nifti(unit) {
  const header = Buffer.alloc(352);
  header.writeInt32LE(348, 0);
  [3, 2, 3, 4, 1, 1, 1, 1].forEach((n, k) => header.writeInt16LE(n, 40 + 2 * k)); // dim
  header.writeInt16LE(2, 70); // datatype: uint8
  header.writeInt16LE(8, 72);
  [1, 5, 6, 7].forEach((n, k) => header.writeFloatLE(n, 76 + 4 * k)); // pixdim
  header.writeFloatLE(352, 108); // vox_offset
  header.writeFloatLE(1, 112); // scl_slope
  header[123] = { mm: 2, um: 3 }[unit]; // xyzt_units
  header.writeInt16LE(1, 252); // qform_code
  header.writeInt16LE(1, 254); // sform_code
  [-10, -20, 30].forEach((n, k) => header.writeFloatLE(n, 268 + 4 * k)); // NIfTI's x and y have the other sign
  [[5, 0, 0, -10], [0, 6, 0, -20], [0, 0, 7, 30]].flat().forEach((n, k) => header.writeFloatLE(n, 280 + 4 * k));
  header.write("n+1\0", 344, "latin1");
  return header;
}

const nrrd = (unit) => `NRRD0004
type: unsigned char
dimension: 3
space: left-posterior-superior
sizes: 2 3 4
space directions: (5,0,0) (0,6,0) (0,0,7)
space units: "${unit}" "${unit}" "${unit}"
kinds: domain domain domain
encoding: raw
space origin: (10,20,30)

`;

const meta = (unit) => `ObjectType = Image
NDims = 3
DistanceUnits = ${unit}
BinaryData = True
BinaryDataByteOrderMSB = False
CompressedData = False
TransformMatrix = 1 0 0 0 1 0 0 0 1
Offset = 10 20 30
CenterOfRotation = 0 0 0
ElementSpacing = 5 6 7
DimSize = 2 3 4
ElementType = MET_UCHAR
ElementDataFile = LOCAL
`;

const digits = (numbers) => Array.from(numbers, (number) => Number(number.toPrecision(6))).join(" ");
for (const unit of ["mm", "um"]) {
  for (const [ending, header] of Object.entries({ nii: nifti, nrrd, mha: meta })) {
    const file = path.join(folder, `${unit}.${ending}`);
    fs.writeFileSync(file, Buffer.concat([Buffer.from(header(unit)), voxels]));
    const image = await readImageNode(file);
    console.log(`${unit}.${ending}: spacing ${digits(image.spacing)}, origin ${digits(image.origin)}`);
  }
}
process.exit(0);
END
node "$scratch/units.mjs" >"$scratch/said" 2>"$scratch/log" || fail "node ends with $(cat "$scratch/log")"
[ ! -s "$scratch/log" ] || fail "node says $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "spacing"
mm.nii: spacing 5 6 7, origin 10 20 30
mm.nrrd: spacing 5 6 7, origin 10 20 30
mm.mha: spacing 5 6 7, origin 10 20 30
um.nii: spacing 0.005 0.006 0.007, origin 0.01 0.02 0.03
um.nrrd: spacing 5 6 7, origin 10 20 30
um.mha: spacing 5 6 7, origin 10 20 30
END
