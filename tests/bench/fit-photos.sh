#!/usr/bin/env bash
# Fits the nine flash photographs of the test data with defaults and scores each best match beside the paper's.
#   tests/bench/fit-photos.sh DATA BIN [patina-cli fit options, for example --map-only]
#   tests/bench/fit-photos.sh DATA BIN --predict        scores the predictors' first guesses instead
# DATA holds photos/ and tools/appearance_distance.py; BIN is the folder of patina-cli. Prints a Markdown table.
# PHOTOS="leather_3 wood_5" does only those. Only material and size are given, as a user would: nothing is tuned by
# hand for a photo.
set -euo pipefail
data=$(realpath "$1") cli=$(realpath "$2")/patina-cli
shift 2
[[ -f $data/tools/appearance_distance.py ]] || { echo "There is no test data in $data: nothing to fit." >&2; exit 0; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Photo, material, side in cm; texture and colour of the paper's MCMC result by the same score.
photos="bump_3 bump 21.21 0.148 4.5
flake_4 flake 10 0.142 4.5
leather_3 leather 10 0.215 10.6
leather_4 leather 21.21 0.239 7.8
leather_6 leather 21.21 0.304 2.9
metal_3 metal 10 0.387 9.3
plaster_3 plaster 21.21 0.208 6.6
wood_3 wood 10 0.324 13.6
wood_5 wood 20 0.157 2.2"

echo "| photo | texture | the paper's | colour | the paper's | seconds |"
echo "|---|---|---|---|---|---|"
while read -r photo material size paper_texture paper_colour; do
  [[ -z ${PHOTOS:-} || " $PHOTOS " == *" $photo "* ]] || continue
  began=$SECONDS
  if [[ ${1:-} == --predict ]]; then
    "$cli" predict "$data/photos/$photo.jpg" --material "$material" --size-cm "$size" --out "$work/$photo.json" >&2
  else
    "$cli" fit "$data/photos/$photo.jpg" --material "$material" --size-cm "$size" --out "$work/$photo" --quiet "$@" >&2
    "$cli" export "$work/$photo" --draw map --format json --out "$work/$photo.json" >&2
  fi
  took=$((SECONDS - began))
  "$cli" render --material "$material" --params "$work/$photo.json" --resolution 512 --size-cm "$size" \
    --out "$work/$photo.png" >&2
  read -r texture colour < <(/usr/bin/python3 "$data/tools/appearance_distance.py" "$data/photos/$photo.jpg" \
    "$work/$photo.png" | awk '{print $2, $4}')
  echo "| $photo | $texture | $paper_texture | $colour | $paper_colour | $took |"
  [[ -z ${KEEP:-} ]] || { mkdir -p "$KEEP" && cp "$work/$photo.png" "$work/$photo.json" "$KEEP/"; }
done <<< "$photos"
