#!/usr/bin/env bash
# Installs what is missing, builds the test preset and runs every test.
#   packaging/test.sh [ctest arguments]
set -euo pipefail
cd "$(dirname "$0")/.."
packaging/install-packages.sh test
cmake --preset test >&2
cmake --build --preset test >&2
ctest --preset test "$@"
