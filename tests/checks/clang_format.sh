#!/usr/bin/env bash
# clang_format.sh CLANG_FORMAT ROOT: fails when a source file is not formatted as .clang-format says.
set -euo pipefail
clang_format=$1
cd "$2"
mapfile -d '' files < <(find common monolithic partitioned meshes packages tests benchmarks -type f \
  \( -name '*.cpp' -o -name '*.hpp' -o -name '*.c' \) -print0)
if [ ${#files[@]} -eq 0 ]; then
  echo "clang_format.sh: error: no source files in $2" >&2
  exit 1
fi
if ! "$clang_format" --dry-run -Werror --style=file "${files[@]}"; then
  echo "clang_format.sh: error: not formatted; run clang-format -i on the files named above" >&2
  exit 1
fi
echo "${#files[@]} files are formatted"
