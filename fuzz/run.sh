#!/bin/sh
# Runs fuzz targets one after the other: run.sh SECONDS PROGRAMS CORPUS OUT TARGET…
# PROGRAMS has the targets that were built, CORPUS/TARGET what a target starts from and adds to. OUT gets the logs, the inputs that
# failed, and summary.txt with a line for each target. Fails if a target did.
set -eu

seconds=$1 programs=$2 corpus=$3 out=$4
shift 4
folder=$(dirname "$0")
mkdir -p "$out/logs"
: > "$out/summary.txt"
failed=0

# The number behind a name in a log's statistics.
statistic() { sed -n "s/^stat::$1: *//p" "$2" | tail -1; }

for target in "$@"; do
  log=$out/logs/$target.log
  artifacts=$out/artifacts/$target
  mkdir -p "$artifacts" "$corpus/$target"
  # How often an edge was taken says little where loops go over meshes, and costs half of the speed.
  options="-max_len=384 -rss_limit_mb=4096 -use_counters=0 -entropic=0 -reduce_inputs=0"
  [ "$target" != readers ] || options="-max_len=2048 -malloc_limit_mb=64 -dict=$folder/readers.dict"
  status=0
  # shellcheck disable=SC2086 # a list of words
  "$programs/$target" $options -max_total_time="$seconds" -timeout=20 -print_final_stats=1 -print_funcs=0 \
    -artifact_prefix="$artifacts/" "$corpus/$target" > "$log" 2>&1 || status=$?
  rm -rf /dev/shm/umbilic-fuzz-*
  crashes=0
  if [ "$status" -ne 0 ]; then
    crashes=1 failed=1
    grep -m 5 -E "panicked|ERROR: |SUMMARY|Test unit written" "$log" || true
  fi
  printf '%-13s %11s executions, %7s a second, %6s edges covered, %s crashes\n' "$target" \
    "$(statistic number_of_executed_units "$log")" "$(statistic average_exec_per_sec "$log")" \
    "$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' "$log" | tail -1)" "$crashes" | tee -a "$out/summary.txt"
done
exit "$failed"
