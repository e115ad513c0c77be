# shellcheck shell=bash disable=SC2154
# A minimal Debian in a folder, to be read by a bash script: made by mmdebstrap, entered by chroot. The script runs in a
# mount and a process namespace of its own and says in `suite`, `level`, `ccache_folder`
# and `debs_folder` what is wanted.

# Mirrors of this Debian that this machine uses, as lines of sources.list; Debian's own where it uses none.
debian_sources() {
  local found
  # The suites of Debian itself and its component main: no one-file repositories of others.
  # shellcheck disable=SC2016  # apt-get fills these in
  found=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' 2>/dev/null |
    sed -nE "s/^([^ ]+) ($suite(-updates|-security)?) main$/deb \1 \2 main/p" | sort -u)
  [ -n "$found" ] || printf 'deb http://deb.debian.org/debian%s main\n' " $suite" " $suite-updates" "-security $suite-security"
  [ -z "$found" ] || echo "$found"
}

# This machine's settings of apt for the way to the mirrors, proxies among them, but no programs that look for them.
network_settings() {
  apt-config dump --format '%F "%v";%n' |
    grep -E '^Acquire::(https?::|ftp::|Check-|Retries|Force|Max-FutureTime)' | grep -Ev 'Auto-?Detect|:: "' || true
}

# make_root FOLDER: the minimal Debian. What is thrown away with its folder need not be on the disk at any moment.
make_root() {
  local options=() setting keys
  while read -r setting; do options+=(--aptopt="$setting"); done < <(network_settings)
  for keys in /etc/apt/keyrings /etc/apt/trusted.gpg.d; do # keys of this machine's mirrors
    [ -z "$(ls -A "$keys" 2>/dev/null)" ] ||
      options+=(--setup-hook="mkdir -p \"\$1/etc/apt/trusted.gpg.d\"; cp $keys/* \"\$1/etc/apt/trusted.gpg.d\"")
  done
  [ -z "$ccache_folder" ] || options+=(--include=ccache)
  [ -z "$fresh_arm" ] || options+=(--architectures=arm64)
  debian_sources | mmdebstrap --mode=root --variant=minbase --format=directory --dpkgopt=force-unsafe-io \
    "${options[@]}" "$suite" "$1" -
  [ -z "$fresh_arm" ] || arm_compiler "$1"
  enter_root "$1"
}

# What a machine's kernel and network give it: /proc, /sys, terminals, shared memory, and the name server.
enter_root() {
  local file
  mount -t proc proc "$1/proc"
  mount -t sysfs -o ro sysfs "$1/sys"
  mount -t devpts -o newinstance,ptmxmode=0666,mode=0620 devpts "$1/dev/pts"
  mount -t tmpfs -o mode=1777 tmpfs "$1/dev/shm"
  for file in resolv.conf hosts; do cat "/etc/$file" >"$1/etc/$file"; done
  if [ -n "$ccache_folder" ]; then
    mkdir -p "$1/ccache"
    mount --bind "$ccache_folder" "$1/ccache"
  fi
}

# root_environment FOLDER: of every program in there that starts in this folder, NAME=VALUE: nothing of this machine's but the proxies and how many compile.
root_environment() {
  local name
  echo "PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
  printf '%s\n' "LANG=C.UTF-8" "TERM=dumb"
  for name in http_proxy https_proxy no_proxy HTTPS_PROXY NO_PROXY CMAKE_BUILD_PARALLEL_LEVEL; do
    [ -z "${!name:-}" ] || echo "$name=${!name}"
  done
  level_environment "$level"
  # Paths below the working folder count as relative ones, so that objects of another clone serve here.
  [ -z "$ccache_folder" ] ||
    printf '%s\n' CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_DIR=/ccache CCACHE_NOHASHDIR=1 "CCACHE_BASEDIR=$1" \
      CCACHE_SLOPPINESS=include_file_mtime,include_file_ctime,time_macros
}

# in_root ROOT USER FOLDER [NAME=VALUE...] COMMAND...: runs a command there, in a folder of it; the user by name or UID:GID.
in_root() {
  local root=$1 user=$2 folder=$3 home environment
  shift 3
  mapfile -t environment < <(root_environment "$folder")
  home=$(sed -nE "s/^$user:([^:]*:){4}([^:]*):.*/\2/p" "$root/etc/passwd")
  chroot --userspec="$user" "$root" /usr/bin/env -i --chdir="$folder" "${environment[@]}" HOME="${home:-/}" "$@"
}

# apt there finds the .deb files of `debs_folder`, by links where that can be, and leaves in it what it has downloaded.
give_debs() {
  [ -n "$debs_folder" ] && compgen -G "$debs_folder/*.deb" >/dev/null || return 0
  cp --link -t "$1/var/cache/apt/archives" "$debs_folder"/*.deb 2>/dev/null ||
    cp -t "$1/var/cache/apt/archives" "$debs_folder"/*.deb
}
take_debs() {
  [ -n "$debs_folder" ] || return 0
  find "$1/var/cache/apt/archives" -maxdepth 1 -name '*.deb' -exec cp --no-clobber -t "$debs_folder" {} +
  rm -f "$1"/var/cache/apt/archives/*.deb
}
