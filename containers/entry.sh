#!/bin/sh
# Entry point of the container: runs one of its programs, with the arguments that it takes.
set -eu

usage() {
  echo "usage: fsi-mesh | fsi-monolithic | fsi-partitioned | fsi-compare | fsi-python | mpirun, and its arguments"
  echo "       --version | --help"
}

# A user whom the container does not know has no home to write to; matplotlib and Open MPI want one.
if [ -z "${HOME:-}" ] || ! [ -w "$HOME" ]; then
  HOME=$(mktemp -d)
  export HOME
  export MPLCONFIGDIR="$HOME"
fi

case "${1:-}" in
  fsi-mesh | fsi-monolithic | fsi-partitioned | fsi-compare | fsi-python | mpirun | sh | bash) exec "$@" ;;
  --version) for program in fsi-mesh fsi-monolithic fsi-partitioned fsi-compare; do "$program" --version; done ;;
  --help) usage ;;
  *)
    echo "fsi-duo: error: '${1:-}' is no program of this container" >&2
    usage >&2
    exit 1
    ;;
esac
