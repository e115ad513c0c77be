#!/usr/bin/env bash
# Makes the Debian packages fsi-duo and fsi-duo-dev for any x86-64 machine since about 2009:
#   scripts/package.sh [-o FOLDER]   into FOLDER (default: build/package)
# Builds the drivers for x86-64-v2, -v3 and -v4; the package holds all three, and starts the best one that the processor
# has. May be run again: only what changed is built anew.
set -euo pipefail
cd_from=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
  echo "package.sh: error: $*" >&2
  exit 1
}

build=$PWD/build/package
output=$build
while [ $# -gt 0 ]; do
  case "$1" in
    -o | --output)
      [ $# -ge 2 ] && [ -n "$2" ] || fail "$1 needs a folder: scripts/package.sh -o FOLDER"
      case "$2" in /*) output=$2 ;; *) output=$cd_from/$2 ;; esac
      shift 2
      ;;
    *) fail "unknown option '$1'; the only one is -o FOLDER" ;;
  esac
done
[ "$(uname -m)" = x86_64 ] || fail "this machine is no x86-64 one; use cpack -G DEB in a build folder"
scripts/install_packages.sh
for tool in dpkg-shlibdeps file; do  # cpack finds with them what the programs depend on
  command -v "$tool" >/dev/null || fail "$tool is missing: install the Debian packages dpkg-dev and file"
done
mkdir -p "$output" || fail "$output cannot be made: give another folder with -o"

# configure LEVEL [OPTION...]: programs without the folders of this machine and without symbols, as cpack leaves its own.
configure() {
  cmake -S . -B "$build/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DFSI_ARCH="x86-64-$1" -DFSI_PYTHON=/usr/bin/python3 \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 -DFSI_TESTS=OFF -DFSI_BENCHMARKS=OFF "${@:2}"
}
for level in v3 v4; do
  echo "== x86-64-$level"
  configure $level -DCMAKE_SKIP_RPATH=ON -DCMAKE_EXE_LINKER_FLAGS=-s
  cmake --build "$build/$level" --target fsi-monolithic fsi-partitioned
done
echo "== x86-64-v2, and the packages"
configure v2 -DFSI_PACKAGE_LEVELS="$build/v3;$build/v4"
cmake --build "$build/v2"
(cd "$build/v2" && cpack -G DEB -B "$output")
rm -rf "$output/_CPack_Packages"

echo
echo "Install with: apt install $(ls -t "$output"/fsi-duo_*.deb | head -1)"
