#!/usr/bin/env bash
# Runs every fuzzer, or those named, for FUZZ_S seconds each (60), FUZZ_JOBS of them at a time (2). fuzz_turn.sh says what
# is kept of it, and where; cmake/fuzz_table.sh adds the turns up.
set -eu
cd "$(dirname "$0")/.."
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target cairn_fuzzers

[ $# -gt 0 ] || set -- $(cd build/fuzz/fuzz && ls | sed -n 's/^fuzz_//p')
printf '%s\n' "$@" | xargs -P "${FUZZ_JOBS:-2}" -I{} cmake/fuzz_turn.sh {}
