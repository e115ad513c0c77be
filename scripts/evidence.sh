#!/usr/bin/env bash
# Makes the kept tables, pages and pictures of docs/ anew, hours, and goes on where it was stopped. --list: what, and minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
exec "${PYTHON:-python3}" -B scripts/evidence/evidence.py "$@"
