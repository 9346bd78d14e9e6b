#!/usr/bin/env bash
# One turn of one fuzzer that has been built: fuzz_turn.sh READER, for FUZZ_S seconds (60). Inputs that show something new
# gather in $FUZZ_FOLDER/found/READER (FUZZ_FOLDER: build/fuzz). What breaks a reader, takes longer than 10 s or more than
# 2 GB is kept in $FUZZ_FOLDER/broken/READER, and the exit status is 1. The turn becomes a line of $FUZZ_FOLDER/turns.log:
# end, reader, inputs, CPU seconds, ok or broken, commit.
set -eu
cd "$(dirname "$0")/.."
name=$1
folder=${FUZZ_FOLDER:-build/fuzz}
TIMEFORMAT='%U %S' LC_ALL=C
found=$folder/found/$name broken=$folder/broken/$name log=$folder/logs/$name.log
mkdir -p "$found" "$broken" "$folder/logs"
options=(-max_len=8192)
case $name in
  saved_map | damaged_map) options=(-max_len=131072) ;;
  yaml | mission | world | template | robot | experiment | map_server | rmf) options+=(-dict=tests/fuzz/yaml.dict) ;;
  plan_queries | json_log | nav2_routes | annotations) options+=(-dict=tests/fuzz/json.dict) ;;
esac
result=ok
{ time "build/fuzz/fuzz/fuzz_$name" -max_total_time="${FUZZ_S:-60}" -timeout="${FUZZ_TIMEOUT_S:-10}" -rss_limit_mb=2048 "${options[@]}" \
  -print_final_stats=1 -artifact_prefix="$broken/" "$found" "tests/fuzz/corpus/$name" </dev/null >"$log" 2>&1; } \
  2>"$log.cpu" || result=broken
inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
echo "$(date -u +%FT%TZ) $name ${inputs:-0} $(tail -n 1 "$log.cpu" | awk '{ print $1 + $2 }') $result" \
  "$(git rev-parse --short HEAD 2>/dev/null || echo -)" >>"$folder/turns.log"
if [ $result = ok ]; then
  echo "$name: $inputs inputs, nothing broken"
else
  echo "$name: broken, the input is in $broken/, the report is $log:"
  grep -m 3 -E 'ERROR|runtime error|what\(\)|SUMMARY' "$log" || tail -n 5 "$log"
  exit 1
fi
