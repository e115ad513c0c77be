#!/usr/bin/env bash
# HDF5's scale-offset filter keeps so many decimals of floating-point numbers. A NaN comes back as the smallest number of its
# chunk: nodes at which a computation has failed look like others. A number that is too large for that many decimals, which is
# how a solver that diverges ends, makes the whole chunk unreadable with HDF5 1.14.5 (Debian 13): it is written without a
# complaint, and so are files of 1.10.8 (Debian 12), which itself stores such a chunk without loss. None of it shows to a program
# that reads back what it has just written, since as long as the data set is open the numbers come from the chunk cache.
# A guess would be that NaN stays NaN or is refused, that such a chunk is stored as it is, and that a file that was written
# without an error can be read.
# Seen through h5py 3.7.0 and 3.13.0.
# Output seen: NaN: at once [10.1234, nan, 13.5, 12.0], reopened [10.1234, 10.1234, 13.5034, 12.0034] in both; 1e20: reopened
# [10.1234, 11.0, 1e+20, 12.0] in 1.10.8, OSError in 1.14.5, of the other's file too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" python3-h5py=3.7.0-8
debian trixie "$scratch/13" python3-h5py=3.13.0-1
cat >"$scratch/fields.py" <<'END'
import sys
import h5py

FIELDS = {"NaN": [10.1234, float("nan"), 13.5, 12.0], "1e20": [10.1234, 11.0, 1e20, 12.0]}


def numbers(data):
    try:
        return data[...].round(12).tolist()
    except OSError:
        return "OSError"


if "write" in sys.argv:
    print("HDF5", h5py.version.hdf5_version)
    with h5py.File("/root/fields.h5", "w") as file:
        for name, values in FIELDS.items():
            data = file.create_dataset(name, data=values, chunks=(4,), scaleoffset=2)
            print(f"{name} at once: {numbers(data)}")
with h5py.File("/root/fields.h5") as file:
    for name in FIELDS:
        print(f"{name} reopened: {numbers(file[name])}")
END
for version in 12 13; do
  cp "$scratch/fields.py" "$scratch/$version/root/"
  within "$scratch/$version" python3 /root/fields.py write
done >"$scratch/said"
cp "$scratch/12/root/fields.h5" "$scratch/13/root/"
within "$scratch/13" python3 /root/fields.py >>"$scratch/said"
cat "$scratch/said"
# By 1.10.8, by 1.14.5, and of 1.10.8's file by 1.14.5.
diff "$scratch/said" - <<'END' || fail "what is read"
HDF5 1.10.8
NaN at once: [10.1234, nan, 13.5, 12.0]
1e20 at once: [10.1234, 11.0, 1e+20, 12.0]
NaN reopened: [10.1234, 10.1234, 13.5034, 12.0034]
1e20 reopened: [10.1234, 11.0, 1e+20, 12.0]
HDF5 1.14.5
NaN at once: [10.1234, nan, 13.5, 12.0]
1e20 at once: [10.1234, 11.0, 1e+20, 12.0]
NaN reopened: [10.1234, 10.1234, 13.5034, 12.0034]
1e20 reopened: OSError
NaN reopened: [10.1234, 10.1234, 13.5034, 12.0034]
1e20 reopened: OSError
END
