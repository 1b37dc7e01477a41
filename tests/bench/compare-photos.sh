#!/usr/bin/env bash
# Which material does each of the nine flash photographs of the test data show, says `patina-cli compare`?
#   tests/bench/compare-photos.sh DATA BIN [patina-cli compare options]
# DATA holds photos/; BIN is the folder of patina-cli. Prints a Markdown table and how many came out right.
# PHOTOS="leather_3 wood_5" does only those. Only the size is given, as a user would.
set -euo pipefail
data=$(realpath "$1") cli=$(realpath "$2")/patina-cli
shift 2
[[ -d $data/photos ]] || { echo "There is no test data in $data: nothing to compare." >&2; exit 0; }

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

json=$(mktemp)
trap 'rm -f "$json"' EXIT
right=0 all=0
echo "| photo | first | log odds of the right one, of the best other | sentence | seconds |"
echo "|---|---|---|---|---|"
while read -r photo material size; do
  [[ -z ${PHOTOS:-} || " $PHOTOS " == *" $photo "* ]] || continue
  began=$SECONDS
  "$cli" compare "$data/photos/$photo.jpg" --size-cm "$size" --quiet --json "$@" > "$json"
  took=$((SECONDS - began))
  row=$(/usr/bin/python3 - "$material" "$json" <<'PYTHON'
import json, sys
right, document = sys.argv[1], json.load(open(sys.argv[2]))
def odds(m): return m["log_evidence"] + m["glance"]
def figure(m): return f"{odds(m):.1f}" + (f" ± {m['error']:.1f}" if m["error"] is not None else "")
first = document["materials"][0]["material"]
own = next(m for m in document["materials"] if m["material"] == right)
other = max((m for m in document["materials"] if m["material"] != right), key=odds)
print(int(first == right))
print(f"{'**' + first + '**' if first == right else first} | {figure(own)}, {figure(other)} ({other['material']}) | {document['sentence']}")
PYTHON
  )
  right=$((right + $(head -n 1 <<< "$row"))) all=$((all + 1))
  echo "| $photo | $(tail -n 1 <<< "$row") | $took |"
done <<< "$photos"
echo
echo "The right material came first on $right of $all."
