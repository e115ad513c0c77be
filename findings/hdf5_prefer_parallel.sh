#!/usr/bin/env bash
# HDF5 2.2 (Debian testing) beside CMake 4.3: find_package(HDF5) finds the serial build although HDF5_PREFER_PARALLEL is ON and
# the parallel one is installed. 2.2 brings CMake files of its own for each build; CMake's FindHDF5 takes the first that it
# finds of these before it looks for the compiler wrapper of the parallel build, and asks for no kind. Up to HDF5 1.14 (Debian 12 and
# 13), which Debian ships without such files, the same three lines give the parallel build. pkg-config names both everywhere:
# hdf5-openmpi and hdf5-serial.
# Output seen: trixie, HDF5 1.14.5: parallel = TRUE; testing, HDF5 2.2.0: parallel = OFF; pkg-config there: -lhdf5_openmpi.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
. ./support.sh

debian trixie "$scratch/13" libhdf5-openmpi-dev=1.14.5+repack-3 libhdf5-dev=1.14.5+repack-3 cmake=3.31.6-2 gcc make pkg-config
debian testing "$scratch/testing" libhdf5-openmpi-dev=2.2.0+repack-5 libhdf5-dev=2.2.0+repack-5 cmake=4.3.4-1 gcc make pkg-config
for root in 13 testing; do
  cat >"$scratch/$root/root/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(asks C)
set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
file(WRITE /root/said "${HDF5_VERSION} ${HDF5_IS_PARALLEL}")
END
  within "$scratch/$root" cmake -S /root -B /root/build >"$scratch/log" 2>&1 || fail "cmake ends with $(cat "$scratch/log")"
  echo "$root: HDF5, parallel = $(cat "$scratch/$root/root/said")"
done
[ "$(cat "$scratch/13/root/said")" = "1.14.5 TRUE" ] || fail "trixie"
[ "$(cat "$scratch/testing/root/said")" = "2.2.0 OFF" ] || fail "testing"
flags=$(within "$scratch/testing" pkg-config --libs hdf5-openmpi)
echo "testing, pkg-config hdf5-openmpi: $flags"
[[ $flags == *hdf5_openmpi* ]] || fail "pkg-config: $flags"
