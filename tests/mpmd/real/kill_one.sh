#!/bin/bash
# kill_one.sh VICTIM MPIEXEC SPH FV CONFIG OPTIONS...: starts both solvers, kills VICTIM (sph or fv) without warning when
# it is under way, and demands that the job ends, not with 0, within seconds.
victim=$1 mpiexec=$2 sph=$3 fv=$4 config=$5
shift 5
out=killed_$victim
rm -rf "$out"
mkdir "$out"
program() { # the program's process id is that of the shell it replaces
  echo "echo \$\$ > $out/$1.pid; exec \"\$@\""
}
timeout -k 5 40 "$mpiexec" --oversubscribe \
  -n 1 bash -c "$(program sph)" sph "$sph" --config "$config/sph.yaml" --out "$out" "$@" \
  : -n 1 bash -c "$(program fv)" fv "$fv" --config "$config/fv.yaml" --out "$out" "$@" >"$out/screen" 2>&1 &
job=$!
trap 'kill $job 2>/dev/null; cat "$out/screen"' EXIT
for _ in $(seq 300); do # until the first windows are done
  [ "$(grep -c '^[0-9]' "$out/$victim/scalars.csv" 2>/dev/null)" -ge 3 ] 2>/dev/null && break
  kill -0 $job 2>/dev/null || { echo "kill_one: the job ended by itself"; exit 1; }
  sleep 0.1
done
kill -KILL "$(cat "$out/$victim.pid")" || exit 1
killed_at=$SECONDS
wait $job
status=$?
[ $status -ne 0 ] && [ $status -ne 124 ] || { echo "kill_one: the job ended with $status"; exit 1; }
[ $((SECONDS - killed_at)) -le 10 ] || { echo "kill_one: the job lived on for $((SECONDS - killed_at)) s"; exit 1; }
lives() { grep -qs '^State:[[:space:]]*[^ZX[:space:]]' "/proc/$(cat "$out/$1.pid")/status"; } # a zombie does not
for _ in $(seq 50); do # nobody is left behind
  lives sph || lives fv || exit 0
  sleep 0.1
done
echo "kill_one: a program outlives the job"
exit 1
