#!/usr/bin/env bash
# h5diff ends with 0, which says no differences, where it could not compare: data sets of other sizes or ranks, integers beside
# floating-point numbers, an empty one. A run that stopped early, or a mesh with other nodes, passes a test by h5diff against a
# reference. It prints "Some objects are not comparable", with -r below "0 differences found", with -q, which is for scripts,
# nothing. A data set that one file lacks gives 1, without a word.
# A guess would be 1 as for other numbers, or 2 as for an error.
# The same in HDF5 1.10.8 (Debian 12) and 1.14.5 (Debian 13). The reference has the numbers 1, 2, 3.
# Output seen: four numbers, a column, integers, and none: status 0, not comparable; 1, 2, 4: status 1, 1 differences found;
# without the data set: status 1, nothing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian bookworm "$scratch/12" hdf5-tools=1.10.8+repack1-1 python3-h5py=3.7.0-8
debian trixie "$scratch/13" hdf5-tools=1.14.5+repack-3 python3-h5py=3.13.0-1
cat >"$scratch/write.py" <<'END'
import h5py, numpy

for name, numbers in (("reference", [1.0, 2, 3]), ("longer", [9.0, 9, 9, 9]), ("column", [[2.0], [3], [4]]),
                      ("integers", [7, 8, 9]), ("empty", numpy.zeros(0)), ("other", [1.0, 2, 4]), ("missing", None)):
    with h5py.File(f"/root/{name}.h5", "w") as file:
        file["time"] = 0.5
        if numbers is not None:
            file["pressure"] = numpy.array(numbers)
END
for version in 12 13; do
  cp "$scratch/write.py" "$scratch/$version/root/"
  within "$scratch/$version" python3 /root/write.py >"$scratch/log" 2>&1 || fail "python ends with $(cat "$scratch/log")"
  for name in longer column integers empty other missing; do
    status=0 quiet=0
    within "$scratch/$version" h5diff /root/reference.h5 "/root/$name.h5" >"$scratch/words" 2>&1 || status=$?
    within "$scratch/$version" h5diff -q /root/reference.h5 "/root/$name.h5" >"$scratch/log" 2>&1 || quiet=$?
    [ ! -s "$scratch/log" ] || fail "h5diff -q says $(cat "$scratch/log")"
    echo "$name: $status, with -q $quiet: $(grep 'differences\|not comparable' "$scratch/words" || echo nothing)"
  done | tee "$scratch/said$version"
  diff "$scratch/said$version" - <<'END' || fail "what h5diff says in Debian $version"
longer: 0, with -q 0: Some objects are not comparable
column: 0, with -q 0: Some objects are not comparable
integers: 0, with -q 0: Some objects are not comparable
empty: 0, with -q 0: Some objects are not comparable
other: 1, with -q 1: 1 differences found
missing: 1, with -q 1: nothing
END
done
