#!/usr/bin/env bash
# Installs the Debian packages that are missing, and nothing else.
#   scripts/install_packages.sh           what building and running needs (packages.txt)
#   scripts/install_packages.sh --tests   and what the tests need (packages-test.txt)
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

fail() {
  echo "install_packages.sh: error: $*" >&2
  exit 1
}

lists=("$here/packages.txt")
for argument in "$@"; do
  case "$argument" in
    --tests) lists+=("$here/packages-test.txt") ;;
    *) fail "unknown option '$argument'; the only one is --tests" ;;
  esac
done
command -v dpkg-query >/dev/null ||
  fail "this is no Debian system; install by hand what corresponds to ${lists[*]}"

# The status word of the package is "installed" whatever is wanted of it later (a package on hold is there as well).
is_installed() { dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed; }

missing=()
while read -r package; do
  is_installed "$package" || missing+=("$package")
done < <(sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "${lists[@]}")
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi

if [ "$(id -u)" -eq 0 ]; then
  as_root=()
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=(sudo -n)
else
  fail "missing packages: ${missing[*]}; as root run: apt-get install --no-install-recommends ${missing[*]}"
fi
echo "installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
# --no-remove: rather stop than take something away that the user has (python3-vtk9, for one).
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends --no-remove "${missing[@]}"
