#!/usr/bin/env bash
# clang_tidy.sh CLANG_TIDY ROOT BUILD COMPILER: fails on any finding of .clang-tidy in the programs' and libraries' sources
# and the headers they include. BUILD holds compile_commands.json, made for COMPILER.
set -euo pipefail
clang_tidy=$1 build=$3 compiler=$4
cd "$2"
mapfile -d '' files < <(find common monolithic partitioned meshes -type f -name '*.cpp' -print0)
if [ ${#files[@]} -eq 0 ]; then
  echo "clang_tidy.sh: error: no source files in $2" >&2
  exit 1
fi
# omp.h is clang's own where libomp-dev is installed, else that of the compiler. What warnings there are is the compiler's
# affair, which knows others.
# Assertions are on: they tell the analyser what holds.
options=(--quiet -p "$build" --extra-arg=-Wno-everything --extra-arg=-UNDEBUG
  "--extra-arg=-idirafter$("$compiler" -print-file-name=include)")
# The analyser follows this many steps through a function; with its own 225000 the whole takes three times as long.
for argument in -Xclang -analyzer-config -Xclang max-nodes=20000; do options+=("--extra-arg=$argument"); done
if ! printf '%s\0' "${files[@]}" |
  xargs -0 -n 1 -P "$(nproc)" "$clang_tidy" "${options[@]}"; then
  echo "clang_tidy.sh: error: see the findings above; .clang-tidy says which checks there are" >&2
  exit 1
fi
echo "${#files[@]} files have no findings"
