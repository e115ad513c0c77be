#!/usr/bin/env bash
# A segmentation that is read by nibabel's get_fdata, and saved again with the header that it came with, holds hardly a label
# any more. get_fdata gives doubles; saving doubles with a header that says uint8 or int16 scales them to the whole range of
# these integers, and the file has multiples of a step: 1 of the labels 0, 1, 2 comes back as 0.996 from uint8. The nearest ones
# differ from their number by some 1e-7, so `== 2` finds none, and a cast to integers makes 1 of a 2. No voxel was changed, and
# nothing is said. Numbers of an integer type, as numpy.asarray(image.dataobj) has them, are saved as they are.
# A guess would be that whole numbers which fit the type of the file are stored as such.
# Seen with nibabel 5.0.0 (Debian 12): 27 voxels, nine of each label 0, 1, 2.
# Output seen, values, voxels equal to 0, 1, 2, and cast to them: uint8 0, 0.99608, 2, [9, 0, 0], [18, 0, 9]; int16 0, 1.00002,
# 2, [9, 0, 0], [9, 18, 0]; by dataobj all are nine.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-nibabel=5.0.0-2
cat >"$scratch/12/root/labels.py" <<'END'
import nibabel, numpy


def show(name, values):
    print(f"{name}: {sorted({round(float(value), 5) for value in values.flat})}, equal to 0, 1, 2:",
          [int((values == label).sum()) for label in range(3)], "as integers:",
          [int((values.astype(int) == label).sum()) for label in range(3)])


for kind in ("uint8", "int16"):
    labels = (numpy.arange(27) % 3).reshape(3, 3, 3).astype(kind)
    nibabel.Nifti1Image(labels, numpy.eye(4)).to_filename("/root/labels.nii")
    image = nibabel.load("/root/labels.nii")
    show(f"{kind}, read", image.get_fdata())
    nibabel.Nifti1Image(image.get_fdata(), image.affine, image.header).to_filename("/root/again.nii")
    show(f"{kind}, saved again", nibabel.load("/root/again.nii").get_fdata())
    nibabel.Nifti1Image(numpy.asarray(image.dataobj), image.affine, image.header).to_filename("/root/again.nii")
    show(f"{kind}, by dataobj", nibabel.load("/root/again.nii").get_fdata())
END
within "$scratch/12" python3 /root/labels.py >"$scratch/said" 2>"$scratch/log" || fail "python ends with $(cat "$scratch/log")"
[ ! -s "$scratch/log" ] || fail "python says $(cat "$scratch/log")"
cat "$scratch/said"
diff "$scratch/said" - <<'END' || fail "labels"
uint8, read: [0.0, 1.0, 2.0], equal to 0, 1, 2: [9, 9, 9] as integers: [9, 9, 9]
uint8, saved again: [0.0, 0.99608, 2.0], equal to 0, 1, 2: [9, 0, 0] as integers: [18, 0, 9]
uint8, by dataobj: [0.0, 1.0, 2.0], equal to 0, 1, 2: [9, 9, 9] as integers: [9, 9, 9]
int16, read: [0.0, 1.0, 2.0], equal to 0, 1, 2: [9, 9, 9] as integers: [9, 9, 9]
int16, saved again: [0.0, 1.00002, 2.0], equal to 0, 1, 2: [9, 0, 0] as integers: [9, 18, 0]
int16, by dataobj: [0.0, 1.0, 2.0], equal to 0, 1, 2: [9, 9, 9] as integers: [9, 9, 9]
END
