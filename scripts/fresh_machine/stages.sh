#!/usr/bin/env bash
# What scripts/fresh_machine.sh does on its machine, stage by stage: called by it alone, in namespaces of their own.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
top=$(cd "$here/../.." && pwd)
log=$fresh_log suite=$fresh_suite level=$fresh_level debs_folder=$fresh_debs ccache_folder=$fresh_ccache
measured=$fresh_folder not_measured=ccache
root=$fresh_folder/root
clone=/home/user/fsi-duo # in there
serial=(${fresh_serial:+"$fresh_serial"})
for part in table level arm root container; do
  # shellcheck disable=SC1090
  . "$here/$part.sh"
done
trap report_failure EXIT

say() { echo "$*" | tee -a "$log"; }

# The last commit, in the hands of root; its own user comes later.
make_clone() {
  in_root "$root" root / useradd --create-home --shell /bin/bash user
  git clone --quiet "$top" "$root$clone"
}
as_root() { in_root "$root" root "$clone" "$@"; }
as_user() { in_root "$root" user "$clone" "$@"; }
give_to_user() { in_root "$root" root / chown -R user:user "$clone"; }

# Of a machine that has nothing yet, no package may be left out.
install_packages() {
  give_debs "$root"
  as_root CI=true scripts/install_packages.sh "$@"
  take_debs "$root"
}

# What the level has come to: registers in the programs, and the kernels that OpenBLAS has chosen.
check_level() {
  local program count wide="512"
  [ "$level" != v2 ] || wide="512 or 256"
  stage_now="processor level"
  for program in fsi-mesh fsi-monolithic fsi-partitioned; do
    [ -x "$root$clone/build/release/bin/$program" ] || continue
    count=$(as_root objdump -d "build/release/bin/$program" | registers_beyond "$level")
    say "  $program: $count instructions with registers of $wide bits"
    case "$level" in v2 | v3) [ "$count" -eq 0 ] ;; esac
  done
  [ "$fresh_mode" = short ] ||
    say "  OpenBLAS: $(as_root OPENBLAS_VERBOSE=2 python3 -c 'import numpy' 2>&1 | paste -sd' ')"
  stage_now=""
}

try_clone() {
  stage "clone" make_clone
  give_debs "$root"
  stage "quickstart, as root" as_root scripts/quickstart.sh "${serial[@]}"
  print_own_stages
  check_level
  [ "$fresh_tests" = no ] || stage "tests, as root" as_root CI=true scripts/test.sh "${serial[@]}"
  take_debs "$root"
  give_to_user
  stage "quickstart, as user" as_user scripts/quickstart.sh "${serial[@]}"
  print_own_stages
  [ "$fresh_tests" = no ] || stage "tests, as user" as_user scripts/test.sh "${serial[@]}"
}

# Without the tests' packages, as they are not configured.
try_short() {
  stage "clone" make_clone
  stage "packages" install_packages
  stage "configure" as_root cmake --preset release -DFSI_TESTS=OFF -DFSI_BENCHMARKS=OFF
  stage "one program" as_root cmake --build build/release --target fsi-mesh
  stage "a run of it" as_root build/release/bin/fsi-mesh artery --level coarse -o artery.msh
  check_level
}

install_package() {
  give_debs "$root"
  cp "$fresh_package" "$root/root/package.deb"
  in_root "$root" root / apt-get update -qq
  in_root "$root" root / DEBIAN_FRONTEND=noninteractive apt-get install -y -qq /root/package.deb
  rm "$root/root/package.deb"
  take_debs "$root"
}
# The page that the package brings, in a folder that has beside it what the page asks for; no other programs are there.
run_tutorial() {
  local page
  in_root "$root" root / useradd --create-home --shell /bin/bash user
  page=$(in_root "$root" root / dpkg -L fsi-duo | grep -E '/tutorial\.md$')
  awk '/^```sh$/ { on = 1; next } /^```$/ { on = 0 } on' "$root$page" >"$root/home/user/tutorial.sh"
  [ "$(wc -l <"$root/home/user/tutorial.sh")" -gt 20 ]
  ln -s /usr/share/fsi-duo/gallery "$root/home/user/gallery"
  in_root "$root" user /home/user bash -eux tutorial.sh
}
try_package() {
  stage "package" install_package
  stage "tutorial, as user" run_tutorial
  say "Programs: $(in_root "$root" user / fsi-monolithic --version)"
}

main() {
  local changed
  say "fsi-duo $(git -C "$top" rev-parse --short HEAD) on a fresh Debian ($suite), processor level: ${level:-that of this machine}${fresh_arm:+; 64-bit Arm by qemu}"
  changed=$(git -C "$top" status --porcelain | wc -l)
  [ "$changed" -eq 0 ] || say "$changed files of the sources differ from this commit; the machine has the commit's"
  stage "minimal Debian" make_root "$root"
  "try_$fresh_mode"
  print_table | tee -a "$log"
}
main
exit
