#!/usr/bin/env bash
# Installs the Debian packages that are missing, and nothing else; never removes one.
#   scripts/install_packages.sh           what building and running needs (packages.txt)
#   scripts/install_packages.sh --tests   and what the tests need (packages-test.txt)
# A package that a list marks `optional` is left out, with a line that says why, where it cannot be installed beside what
# the machine has. Not so in continuous integration (CI=true), which has to run every test.
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

# Packages that dpkg has begun with and not ended, of whatever origin: apt refuses to install anything beside them.
half_done() { dpkg-query -W -f='${db:Status-Status} ${Package}\n' |
  sed -nE 's/^(half-installed|unpacked|half-configured) (.*)/\2 (\1)/p' | paste -sd, ; }

missing=() optional=()
while read -r package mark; do
  is_installed "$package" && continue
  case "$mark" in
    "") missing+=("$package") ;;
    optional) optional+=("$package") ;;
    *) fail "${lists[*]}: '$package $mark': the only mark of a package is 'optional'" ;;
  esac
done < <(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "${lists[@]}")

broken=$(half_done)
apt() { env DEBIAN_FRONTEND=noninteractive apt-get "$@" -qq --no-install-recommends --no-remove; }
installable() { apt install --simulate "$@" >/dev/null 2>&1; }

# Why apt leaves a package out: what it excludes and is there, or apt's own words.
reason_for() {
  local other
  while read -r other; do
    if is_installed "$other"; then
      echo "it excludes $other, which is installed"
      return
    fi
  done < <(apt-cache show "$1" 2>/dev/null | sed -nE 's/^(Conflicts|Breaks): //p' | sed -e 's/([^)]*)//g' -e 's/,/\n/g' |
    tr -d ' ' | sort -u)
  apt install --simulate "$@" 2>&1 | sed -nE 's/^E: //p' | head -1
}

if [ ${#missing[@]} -eq 0 ] && [ ${#optional[@]} -eq 0 ]; then
  exit 0
fi

if [ "$(id -u)" -eq 0 ]; then
  as_root=()
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=(sudo -n)
elif [ ${#missing[@]} -eq 0 ]; then
  as_root=()  # only optional ones are missing: what cannot be installed is left out below
else
  fail "missing packages: ${missing[*]} ${optional[*]}; as root run: apt-get install --no-install-recommends" \
    "${missing[*]} ${optional[*]}"
fi
[ ${#missing[@]} -eq 0 ] || [ -z "$broken" ] ||
  fail "packages on this machine are half done: $broken; as root run: dpkg --configure -a, or remove them"

may_install() { [ "$(id -u)" -eq 0 ] || [ ${#as_root[@]} -gt 0 ]; }
if may_install; then "${as_root[@]}" apt-get update -qq; fi
for package in "${optional[@]}"; do
  if may_install && [ -z "$broken" ] && installable "${missing[@]}" "$package"; then
    missing+=("$package")
    continue
  fi
  if ! may_install; then
    reason="it is not installed, and this user may not install it"
  elif [ -n "$broken" ]; then
    reason="packages on this machine are half done: $broken"
  else
    reason=$(reason_for "$package")
  fi
  [ "${CI:-}" != true ] || fail "$package cannot be installed: ${reason:-no reason given}"
  echo "left out $package and the tests that need it: ${reason:-apt gives no reason}"
done
[ ${#missing[@]} -gt 0 ] || exit 0

echo "installing ${missing[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends --no-remove "${missing[@]}" ||
  fail "apt-get could not install them (above); nothing was removed. Packages half done: $(half_done | sed 's/^$/none/')"
