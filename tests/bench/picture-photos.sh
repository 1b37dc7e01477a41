#!/usr/bin/env bash
# How many pixels and levels of the network does each of the nine flash photographs of the test data need?
#   tests/bench/picture-photos.sh DATA BIN [patina-cli fit options, for example --minutes 3]
# DATA holds photos/; BIN is the folder of patina-cli. Fits each, asks `summarize --picture`, prints a Markdown table.
# PHOTOS="leather_3 wood_5" does only those.
set -euo pipefail
data=$(realpath "$1") cli=$(realpath "$2")/patina-cli
shift 2
[[ -d $data/photos ]] || { echo "There is no test data in $data: nothing to fit." >&2; exit 0; }

# Photo, material, side in cm.
photos="bump_3 bump 21.21
flake_4 flake 10
leather_3 leather 10
leather_4 leather 21.21
leather_6 leather 21.21
metal_3 metal 10
plaster_3 plaster 21.21
wood_3 wood 10
wood_5 wood 20"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo "| photo | least effective draws | tried: what differs most, in posterior sds | agrees | times as fast |"
echo "|---|---|---|---|---|"
while read -r photo material size; do
  [[ -z ${PHOTOS:-} || " $PHOTOS " == *" $photo "* ]] || continue
  "$cli" fit "$data/photos/$photo.jpg" --material "$material" --size-cm "$size" --out "$work/$photo" --quiet "$@" >&2
  "$cli" summarize "$work/$photo" --picture --json > "$work/$photo.json" 2> /dev/null
  /usr/bin/python3 - "$photo" "$work/$photo.json" <<'PYTHON'
import json, sys
run = json.load(open(sys.argv[2]))
ess = [p["bulk_ess"] for p in run["parameters"].values() if p["bulk_ess"] and p["sd"]]
tried = run["picture"]["tried"]
says = "; ".join(f"{t['resolution']} {t['summary']}: {t['differs_most']} {t['difference']:+.2f} ± {t['error']:.2f}" for t in tried)
agrees = [t for t in tried if t["agrees"]]
best = agrees[-1] if agrees else None
print(f"| {sys.argv[1]} | {min(ess):.0f} | {says} | " + (f"{best['resolution']} {best['summary']} | {best['times_as_fast']:.1f} |" if best else "none | |"))
PYTHON
done <<< "$photos"
