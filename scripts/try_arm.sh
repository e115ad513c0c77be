#!/usr/bin/env bash
# Compiles for 64-bit Arm on an x86-64 machine, with warnings as errors, and runs unit tests there by an emulator:
#   scripts/try_arm.sh [FOLDER]
# In FOLDER, new or that of an earlier call, otherwise a temporary one, it makes a minimal Debian 12 with a cross compiler
# and the libraries of Arm, and compiles in it the last commit: the programs without MPI, and the tests of math, fem, algebra
# and materials, which qemu runs. Needs root and the Debian packages mmdebstrap and qemu-user-static. Exit code 1 where
# something fails.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

fail() {
  echo "try_arm.sh: error: $*" >&2
  exit 1
}

[ $# -le 1 ] || fail "one folder at most"
[ "$(id -u)" -eq 0 ] || fail "needs root, for chroot"
for needed in "mmdebstrap mmdebstrap" "qemu-aarch64-static qemu-user-static"; do
  command -v "${needed%% *}" >/dev/null || fail "${needed%% *} is missing; install the Debian package ${needed##* }"
done

if [ $# -eq 1 ]; then
  mkdir -p "$1"
  folder=$(cd "$1" && pwd)
else
  folder=$(mktemp -d)
  trap 'rm -rf --one-file-system "$folder"' EXIT
fi
root=$folder/root
tools=cmake,ninja-build,pkg-config,g++-aarch64-linux-gnu,python3-minimal,python3-numpy,python3-matplotlib,python3-h5py,python3-jinja2,libeigen3-dev,libcli11-dev,nlohmann-json3-dev
libraries=libfmt-dev:arm64,libspdlog-dev:arm64,zlib1g-dev:arm64,liblzma-dev:arm64,libtomlplusplus-dev:arm64,libhdf5-dev:arm64
libraries+=,libsuitesparse-dev:arm64,libopenblas-pthread-dev:arm64,libmetis-dev:arm64,libgmsh-dev:arm64,libcgal-dev:arm64
libraries+=,libgtest-dev:arm64,libgmock-dev:arm64
if [ ! -e "$folder/made" ]; then
  rm -rf --one-file-system "$root"
  mmdebstrap --quiet --variant=minbase --architectures=amd64,arm64 --aptopt='APT::Install-Recommends "false"' \
    --include="$tools,$libraries" bookworm "$root"
  touch "$folder/made"
fi
cp "$(command -v qemu-aarch64-static)" "$root/usr/bin/"
rm -rf "$root/source"
git clone --quiet "$top" "$root/source"
unshare --mount --propagation private --pid --fork --kill-child bash -c '
  mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && exec chroot "$0" env -i \
    PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 HOME=/root bash -euo pipefail -c "
      cd /source
      cmake --preset serial -B /build --toolchain cmake/aarch64.cmake -DFSI_NATIVE=OFF -DFSI_BENCHMARKS=OFF \
        -DFSI_TEST_CASES=OFF -DFSI_WARNINGS_AS_ERRORS=ON \
        -DCLANG_FORMAT=/bin/true -DCLANG_TIDY=/bin/true -DBLACK=/bin/true -DMYPY=/bin/true  # the checks do not run here
      cmake --build /build --target test_math test_fem test_algebra test_materials fsi-mesh fsi-monolithic fsi-partitioned
      for test in math fem algebra materials; do qemu-aarch64-static /build/bin/test_\$test --gtest_brief=1; done
      qemu-aarch64-static /build/bin/fsi-monolithic --version
    "' "$root"
