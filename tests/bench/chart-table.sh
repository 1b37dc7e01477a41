#!/bin/sh
# The table of resources/charts/README.md: chart-table.sh CHARTS
# Of each material's chart.csv and each setting, medians over the repeats: seconds of an effective draw of the
# worst parameter, in brackets the error of the worst mean in posterior sds. A dash: no draws in its time.
set -eu
cd "${1:?the folder of the charts}"
awk -F, '
function median(list,    n, i, j, v, t) {
  n = split(list, v, " ")
  for (i = 2; i <= n; i++) for (j = i; j > 1 && v[j] + 0 < v[j - 1] + 0; j--) { t = v[j]; v[j] = v[j - 1]; v[j - 1] = t }
  return n % 2 ? v[(n + 1) / 2] : (v[n / 2] + v[n / 2 + 1]) / 2
}
FNR == 1 { split(FILENAME, path, "/"); material = path[1]; rows[++materials] = material; head = 0 }
/^#/ { next }
!head { for (i = 1; i <= NF; i++) at[$i] = i; head = 1; next }
{
  name = $at["setting"]
  if (!(name in known)) { known[name] = 1; names[++columns] = name }
  tried[material, name] = 1
  s = $at["seconds_per_effective_draw"]; e = $at["mean_error"]
  if (s !~ /nan|inf/) seconds[material, name] = seconds[material, name] " " s
  if (e !~ /nan|inf/) errors[material, name] = errors[material, name] " " e
}
END {
  line = "| "; rule = "|---"
  for (c = 1; c <= columns; c++) { line = line "| " names[c] " "; rule = rule "|---" }
  print line "|"; print rule "|"
  for (m = 1; m <= materials; m++) {
    line = "| [" rows[m] "](" rows[m] "/chart.svg) "
    for (c = 1; c <= columns; c++) {
      k = rows[m] SUBSEP names[c]
      if (k in seconds) line = line sprintf("| %.2g (%.2g) ", median(seconds[k]), median(errors[k]))
      else line = line (k in tried ? "| – " : "| ")
    }
    print line "|"
  }
}' */chart.csv
