#!/usr/bin/env bash
# All checks: unit tests under the address and undefined-behaviour sanitizers, then the release build with every test.
# Ends with ctest's summary of the release tests; any failure ends it earlier or makes its exit code non-zero.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_packages.sh --tests

echo "== unit tests with sanitizers"
cmake --preset sanitize -DFSI_TESTS=ON
cmake --build --preset sanitize --target unit_tests
ctest --test-dir build/sanitize -L '^unit$' -j2 --output-on-failure --no-tests=error

echo "== all tests, release build"
cmake --preset release -DFSI_TESTS=ON
cmake --build --preset release
ctest --test-dir build/release -j2 --output-on-failure --no-tests=error
