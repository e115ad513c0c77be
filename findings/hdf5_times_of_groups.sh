#!/usr/bin/env bash
# Files that HDF5 2.2 (Debian testing) makes by its defaults hold the time of day, so that two runs that write the same numbers
# have files with other bytes. Of a data set that is switched off by H5Pset_obj_track_times(), which is what a program does that
# wants the same bytes. But since HDF5 2 the default format of a new file is that of HDF5 1.8, in which groups have times, too:
# the root group, and those that H5Pset_create_intermediate_group() makes on the way to a data set. Up to 1.14 (Debian 13) the
# default is the first format, whose groups have none. H5Pset_libver_bounds(H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), the former
# default, gives the same bytes again.
# A guess would be that switching it off for data sets is enough, as it was for years, and that 2.2 writes what 1.14 wrote.
# Output seen, of two files made a good second apart: trixie, HDF5 1.14.5: default: superblock 0, equal; earliest: superblock 0,
# equal; testing, HDF5 2.2.0: default: superblock 2, differ; earliest: superblock 0, equal.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian trixie "$scratch/13" libhdf5-dev=1.14.5+repack-3 gcc pkg-config
debian testing "$scratch/testing" libhdf5-dev=2.2.0+repack-5 gcc pkg-config
for root in 13 testing; do
  cat >"$scratch/$root/root/makes.c" <<'END'
#include <hdf5.h>

/* makes FILE [earliest]: a file with one data set in a group, whose times are not to be kept. */
int main(int count, char** words) {
  hid_t access = H5Pcreate(H5P_FILE_ACCESS), links = H5Pcreate(H5P_LINK_CREATE), creation = H5Pcreate(H5P_DATASET_CREATE);
  if (count > 2) H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  H5Pset_create_intermediate_group(links, 1);
  H5Pset_obj_track_times(creation, 0);
  hid_t file = H5Fcreate(words[1], H5F_ACC_TRUNC, H5P_DEFAULT, access);
  const hsize_t size = 2;
  const double values[2] = {1, 2};
  hid_t space = H5Screate_simple(1, &size, NULL);
  hid_t set = H5Dcreate2(file, "fluid/pressure", H5T_NATIVE_DOUBLE, space, links, creation, H5P_DEFAULT);
  herr_t status = H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  H5Dclose(set), H5Sclose(space);
  return status < 0 || H5Fclose(file) < 0;
}
END
  cat >"$scratch/$root/root/try.sh" <<'END'
set -e
cd /root
gcc makes.c -o makes $(pkg-config --cflags --libs hdf5-serial)
echo "HDF5 $(pkg-config --modversion hdf5-serial)"
for format in default earliest; do
  word=${format#default}
  ./makes one.h5 $word
  sleep 1.2
  ./makes two.h5 $word
  if cmp -s one.h5 two.h5; then same=equal; else same=differ; fi
  echo "$format: superblock $(od -An -tu1 -j8 -N1 one.h5 | tr -d ' '), $same"
done
END
  within "$scratch/$root" sh /root/try.sh | tee "$scratch/$root/said"
done
diff "$scratch/13/said" - <<'END' || fail "trixie"
HDF5 1.14.5
default: superblock 0, equal
earliest: superblock 0, equal
END
diff "$scratch/testing/said" - <<'END' || fail "testing"
HDF5 2.2.0
default: superblock 2, differ
earliest: superblock 0, equal
END
