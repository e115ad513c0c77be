# shellcheck shell=bash disable=SC2154
# The steps of containers/Containerfile by chroot, a minimal Debian 12 for each FROM; to be read by stages.sh.

container_environment=() container_folder=/ container_root="" container_entry=() container_steps=0

# copy_into SOURCE... TARGET: as COPY does it, which takes of a folder what is in it.
copy_into() {
  local target=${*: -1} source
  for source in "${@:1:$#-1}"; do
    if [ -d "$source" ]; then
      mkdir -p "$target" && cp -a "$source/." "$target"
    elif [[ $target == */ ]]; then
      mkdir -p "$target" && cp -a -t "$target" "$source"
    else
      mkdir -p "$(dirname "$target")" && cp -a "$source" "$target"
    fi
  done
}

new_root() {
  mkdir "$1"
  tar -C "$root" --one-file-system --exclude=./ccache -c . | tar -C "$1" -x
  enter_root "$1"
  give_debs "$1"
}

run_step() {
  in_root "$container_root" root "$container_folder" "${container_environment[@]}" /bin/sh -c "$1"
}

copy_step() {
  local from=$fresh_folder/context words=() word
  [ "$1" = . ] || from=$fresh_folder/$1
  for word in "${@:2:$#-2}"; do words+=("$from/${word#/}"); done
  copy_into "${words[@]}" "$container_root${*: -1}"
}

# perform INSTRUCTION WORD...: one line of containerfile.py.
perform() {
  local kind=$1
  shift
  container_steps=$((container_steps + 1))
  case "$kind" in
    root)
      [ -z "$container_root" ] || take_debs "$container_root"
      container_root=$fresh_folder/$1 container_environment=() container_folder=/ container_entry=()
      stage "FROM: $1" new_root "$container_root"
      ;;
    environment) container_environment+=("$@") ;;
    folder)
      container_folder=$1
      mkdir -p "$container_root$1"
      ;;
    copy) stage "COPY, step $container_steps" copy_step "$@" ;;
    run) stage "RUN, step $container_steps" run_step "$1" ;;
    entry) container_entry=("$@") ;;
  esac
}

# As a user whom the container does not know, in a folder of the machine's own that is mounted over /work.
in_container() {
  echo "+ ${container_entry[*]} $*"
  in_root "$container_root" 12345:12345 "$container_folder" "${container_environment[@]}" "${container_entry[@]}" "$@"
}
run_case() {
  local mesh=(--axisymmetric --length 3 --lumen-cells 2 --media-cells 1 --adventitia-cells 1 --axial-cells 8 --order 2)
  mkdir "$fresh_folder/work"
  chown 12345:12345 "$fresh_folder/work"
  mount --bind "$fresh_folder/work" "$container_root/work"
  cp "$fresh_folder/context/meshes/artery/neo-hookean.toml" "$fresh_folder/work/case.toml"
  in_container fsi-mesh artery "${mesh[@]}" -o artery.msh
  local of_case=(case.toml --set geometry=axisymmetric --set element=p2p1 --set mesh.file=artery.msh --set time.end=0.5)
  in_container fsi-monolithic "${of_case[@]}" -o monolithic
  in_container fsi-partitioned "${of_case[@]}" -o partitioned
  in_container mpirun -n 2 --oversubscribe fsi-monolithic "${of_case[@]}" --threads 1 -o two
  in_container fsi-compare pressure monolithic partitioned two --times 0.5 -o compared
  [ -s "$fresh_folder/work/compared/pressure_waves.png" ]
  ! in_container no-such-program || return 1
}

try_container() {
  local steps instruction words
  mkdir "$fresh_folder/context"
  git -C "$top" archive HEAD | tar -C "$fresh_folder/context" -x
  steps=$(python3 -B "$here/containerfile.py" "$fresh_folder/context/containers/Containerfile" \
    ${level:+"FSI_ARCH=x86-64-$level"})
  while IFS= read -r instruction; do
    IFS=$'\t' read -r -a words <<<"$instruction"
    perform "${words[@]}" </dev/null
  done <<<"$steps"
  take_debs "$container_root"
  stage "entry point, --version" in_container --version
  stage "entry point, a case" run_case
  umount "$container_root/work"
  say "The image has $(measured=$container_root used_kib) KiB; a minimal Debian $(measured=$root used_kib)"
}
