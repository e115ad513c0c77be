# shellcheck shell=bash
# To be read by the scripts of this folder. They need root, mmdebstrap and Debian's mirror.

scratch=$(mktemp -d)
trap 'rm -rf --one-file-system "$scratch"' EXIT

# fail WORDS...: the behaviour is no longer what the script says.
fail() {
  echo "${0##*/}: changed: $*" >&2
  exit 1
}

# debian SUITE FOLDER PACKAGE=VERSION...: a minimal Debian with these packages in a new folder. Fails where the mirror has
# other versions by now.
debian() {
  local suite=$1 folder=$2 IFS=,
  shift 2
  # Suites that a mirror keeps as they were have lists that ended.
  mmdebstrap --quiet --variant=minbase --aptopt='Acquire::Check-Valid-Until "false"' --include="$*" "$suite" "$folder" || {
    echo "${0##*/}: cannot install $* of Debian $suite" >&2
    exit 2
  }
}

# within FOLDER COMMAND...: runs a command there, with /proc and devices of its own.
within() {
  local folder=$1
  shift
  unshare --mount --propagation private --pid --fork --kill-child bash -c '
    mount -t proc proc "$0/proc" && mount -t sysfs -o ro sysfs "$0/sys" && mount --rbind /dev "$0/dev" &&
      exec chroot "$0" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 HOME=/root "$@"' "$folder" "$@"
}
