#!/usr/bin/env bash
# What the fuzzers have run, as the table of docs/results/fuzzing.md: the turns in build/fuzz/turns.log, or in the files named,
# added up for each reader. A line of them: end, reader, inputs, CPU seconds, ok or broken, commit.
set -eu
export LC_ALL=C
[ $# -gt 0 ] || set -- "$(dirname "$0")/../build/fuzz/turns.log"
echo "| reader | inputs | CPU time, min | turns | broken |"
echo "|---|---:|---:|---:|---:|"
awk '{ inputs[$2] += $3; cpu_s[$2] += $4; ++turns[$2]; broken[$2] += $5 != "ok" }
  END { for (name in turns)
    printf "| %s | %d | %.1f | %d | %d |\n", name, inputs[name], cpu_s[name] / 60, turns[name], broken[name] }' "$@" | sort
