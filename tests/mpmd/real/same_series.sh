#!/bin/bash
# same_series.sh ROWS A B NAME...: the last ROWS rows of the series NAME (as fv/scalars.csv) of two runs A and B agree to
# the last digit, but for the wall times.
set -e
rows=$1 a=$2 b=$3
shift 3
physics() {
  local columns
  columns=$(head -n 1 "$1" | tr ',' '\n' | grep -n -v '^seconds_' | cut -d: -f1 | paste -sd,)
  cut -d, -f"$columns" "$1"
}
for name in "$@"; do
  for run in "$a" "$b"; do
    found=$(grep -c '^[0-9]' "$run/$name")
    [ "$found" -ge "$rows" ] || { echo "same_series: $run/$name has $found rows where $rows are due"; exit 1; }
  done
  diff <(physics "$a/$name" | head -n 1) <(physics "$b/$name" | head -n 1)
  diff <(physics "$a/$name" | tail -n "$rows") <(physics "$b/$name" | tail -n "$rows")
done
