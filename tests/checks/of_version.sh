#!/usr/bin/env bash
# of_version.sh TOOL VERSION COMMAND...: runs a check by a tool of this version; by another one it is skipped (exit code 77). What
# formatters and analysers find differs from version to version: that of Debian 12 decides.
set -euo pipefail
tool=$1 version=$2
shift 2
found=$("$tool" --version | head -n 1)
case " $found " in
*[!0-9.]"$version".*) exec "$@" ;;
esac
echo "of_version.sh: skipped: the check is by version $version of $(basename "$tool"), and here is: $found"
exit 77
