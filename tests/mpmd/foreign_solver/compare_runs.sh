#!/bin/bash
# compare_runs.sh A B: the series of two runs agree to the last digit, but for the wall times.
set -e
physics() { head -n 1 "$1" | tr ',' '\n' | grep -n -v '^seconds_' | cut -d: -f1 | paste -sd, | xargs -I{} cut -d, -f{} "$1"; }
lines=$(wc -l <"$1/sph/scalars.csv")
[ "$lines" -ge 10 ] || { echo "compare_runs: $1 has only $lines lines"; exit 1; }
diff <(physics "$1/sph/scalars.csv") <(physics "$2/sph/scalars.csv")
