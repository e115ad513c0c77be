# shellcheck shell=bash
# 64-bit Arm on another machine: the kernel hands programs of Arm to qemu. To be read by root.sh and fresh_machine.sh.
# Compiling that way takes ten times as long. So the passes of the compiler that take nearly all of it, and the assembler,
# are those of the cross compiler of the same version: programs of this machine, which the compiler there starts.
arm_handler=/proc/sys/fs/binfmt_misc/qemu-aarch64
arm_version=12 # of Debian 12's compiler
arm_passes=("/usr/lib/gcc-cross/aarch64-linux-gnu/$arm_version/cc1" "/usr/lib/gcc-cross/aarch64-linux-gnu/$arm_version/cc1plus"
  /usr/bin/aarch64-linux-gnu-as)

# What this machine lacks for it: a line, or nothing.
arm_lacks() {
  local pass
  # F: the kernel has opened qemu, so that it serves below another root, too.
  grep -qs '^flags:.*F' "$arm_handler" ||
    { echo "the kernel hands no programs of Arm to qemu; install the Debian packages qemu-user-static and binfmt-support"; return; }
  for pass in "${arm_passes[@]}"; do
    [ -x "$pass" ] || { echo "$pass is missing; install the Debian package g++-$arm_version-aarch64-linux-gnu"; return; }
  done
}

# arm_compiler ROOT: before a compiler is installed there. dpkg puts its passes beside those of this machine.
arm_compiler() {
  local own=/opt/passes native pass name library
  mkdir -p "$1$own"
  for pass in "${arm_passes[@]}"; do
    name=$(basename "$pass")
    cp -L "$pass" "$1$own/$name"
    while read -r library; do cp -Lu "$library" "$1$own/"; done < <(ldd "$pass" | grep -o '/[^ ]*')
    case "$name" in
      cc1*) native=/usr/lib/gcc/aarch64-linux-gnu/$arm_version/$name ;;
      *) native=/usr/bin/$name ;;
    esac
    chroot "$1" dpkg-divert --quiet --local --no-rename --divert "$native.emulated" --add "$native"
    mkdir -p "$1$(dirname "$native")"
    printf '#!/bin/sh\nexec %s/ld-linux-x86-64.so.2 --library-path %s %s/%s "$@"\n' $own $own $own "$name" >"$1$native"
    chmod +x "$1$native"
  done
  # Where a cross compiler looks for headers.
  mkdir -p "$1/usr/lib/gcc-cross/aarch64-linux-gnu/$arm_version" "$1/usr/aarch64-linux-gnu/include/c++" "$1/usr/include/c++/$arm_version"
  ln -s "../../../gcc/aarch64-linux-gnu/$arm_version/include" "$1/usr/lib/gcc-cross/aarch64-linux-gnu/$arm_version/include"
  ln -s "../../../include/c++/$arm_version" "$1/usr/aarch64-linux-gnu/include/c++/$arm_version"
  ln -s "../../aarch64-linux-gnu/c++/$arm_version" "$1/usr/include/c++/$arm_version/aarch64-linux-gnu"
}
