#!/usr/bin/env bash
# Installs what is missing, builds Patina and starts it.
#   packaging/run.sh [PHOTO or run directory]      without one: a bundled sample
# Where there is no display the same program runs off screen for a while and saves a picture of its window.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
arguments=()
for argument in "$@"; do arguments+=("$(realpath -m -- "$argument")"); done

"$root/packaging/install-packages.sh" build
cd "$root"
[[ -f build/release/build.ninja ]] || cmake --preset release >&2
cmake --build --preset release >&2

patina=build/release/bin/patina
if [[ -n ${DISPLAY:-} ]]; then
  exec "$patina" "${arguments[@]}"
fi
picture=$PWD/patina-window.png
echo "There is no display here, so Patina runs off screen for 30 seconds and saves its window to $picture" >&2
exec "$patina" --offscreen "$picture" --seconds 30 "${arguments[@]}"
