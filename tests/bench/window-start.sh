#!/usr/bin/env bash
# How long a user waits for the window, and for what it opens, from the start of the process, in a real window:
#   tests/bench/window-start.sh PATINA [TIMES]      needs Xvfb and xdotool; figures to 20 ms
set -euo pipefail
patina=$(realpath "$1")
times=${2:-5}
photo=$(dirname "$(realpath "$0")")/../../resources/photos/sample_bump.png
home=$(mktemp -d)
exec {number}<> <(:)
Xvfb -displayfd "$number" -screen 0 1280x800x24 -nolisten tcp 2> /dev/null &
server=$!
trap 'kill $server 2> /dev/null; rm -rf "$home"' EXIT
read -r -u "$number" display
export DISPLAY=:$display HOME=$home XDG_DATA_HOME=$home XDG_CONFIG_HOME=$home

wait_for() { until xdotool search --onlyvisible --name "$1" > /dev/null 2>&1; do sleep 0.02; done; }
for ((i = 0; i < times; ++i)); do
  begin=$(date +%s%N)
  "$patina" --size 1280x800 "$photo" > /dev/null 2>&1 &
  program=$!
  wait_for '^Patina$'
  window=$(date +%s%N)
  wait_for '^sample_bump'
  opened=$(date +%s%N)
  kill $program && wait $program 2> /dev/null || true
  echo "window $(((window - begin) / 1000000)) ms, photo $(((opened - begin) / 1000000)) ms"
done
