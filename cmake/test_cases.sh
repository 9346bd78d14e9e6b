#!/usr/bin/env bash
# What the test programs of the last ctest run in a build folder held: how many cases ran, and which were skipped.
set -eu
log=$1/Testing/Temporary/LastTest.log
awk '/^\[==========\] [0-9]+ tests? from .* ran\./ { cases += $2; ++programs }
  /^\[  SKIPPED \] .* ms\)$/ { skipped[++n] = $4 }
  END {
    printf "%d test cases ran in %d programs, %d skipped\n", cases, programs, n
    for (i = 1; i <= n; ++i) printf "  %s (Skipped)\n", skipped[i]
  }' "$log"
