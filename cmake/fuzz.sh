#!/usr/bin/env bash
# Runs every fuzzer, or those named, for FUZZ_S seconds each (60), FUZZ_JOBS of them at a time (2). Inputs that show
# something new gather in build/fuzz/found/NAME. What breaks a reader, takes longer than 10 s or more than 2 GB is kept in
# build/fuzz/broken/NAME, and the exit status is 1. Every turn is a line of build/fuzz/turns.log, which
# cmake/fuzz_table.sh adds up: end, reader, inputs, CPU seconds, ok or broken.
set -eu
cd "$(dirname "$0")/.."
export FUZZ_S=${FUZZ_S:-60}
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target cairn_fuzzers

run_one() {
  name=$1
  local TIMEFORMAT='%U %S' LC_ALL=C
  found=build/fuzz/found/$name broken=build/fuzz/broken/$name log=build/fuzz/logs/$name.log
  mkdir -p "$found" "$broken" build/fuzz/logs
  options=(-max_len=8192)
  case $name in
    saved_map | damaged_map) options=(-max_len=131072) ;;
    yaml | mission | world | template | robot | experiment | map_server | rmf) options+=(-dict=tests/fuzz/yaml.dict) ;;
    plan_queries | json_log | nav2_routes | annotations) options+=(-dict=tests/fuzz/json.dict) ;;
  esac
  result=ok
  { time "build/fuzz/fuzz/fuzz_$name" -max_total_time="$FUZZ_S" -timeout=10 -rss_limit_mb=2048 "${options[@]}" \
    -print_final_stats=1 -artifact_prefix="$broken/" "$found" "tests/fuzz/corpus/$name" </dev/null >"$log" 2>&1; } \
    2>"$log.cpu" || result=broken
  inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  echo "$(date -u +%FT%TZ) $name ${inputs:-0} $(tail -n 1 "$log.cpu" | awk '{ print $1 + $2 }') $result" >>build/fuzz/turns.log
  if [ $result = ok ]; then
    echo "$name: $inputs inputs, nothing broken"
  else
    echo "$name: broken, the input is in $broken/, the report is $log:"
    grep -m 3 -E 'ERROR|runtime error|what\(\)|SUMMARY' "$log" || tail -n 5 "$log"
    return 1
  fi
}
export -f run_one

[ $# -gt 0 ] || set -- $(cd build/fuzz/fuzz && ls | sed -n 's/^fuzz_//p')
printf '%s\n' "$@" | xargs -P "${FUZZ_JOBS:-2}" -I{} bash -c 'run_one {}'
