#!/usr/bin/env bash
# Runs the fuzzers, or those named, until each has had FUZZ_MIN minutes of CPU time (20): one at a time, at the lowest
# priority, in turns of FUZZ_S seconds (120), whichever has had least comes next. It can be ended at any time and goes on
# where it was: the turns and the inputs found stay in FUZZ_FOLDER (build/fuzz_long), so that several evenings add up.
# A reader that breaks gets no further turn in this run; the exit status is 1 then.
set -eu
cd "$(dirname "$0")/.."
export FUZZ_FOLDER=${FUZZ_FOLDER:-build/fuzz_long} FUZZ_S=${FUZZ_S:-120} LC_ALL=C
export FUZZ_TIMEOUT_S=${FUZZ_TIMEOUT_S:-60}  # wall clock, of which the lowest priority may get little
cmake --preset fuzz >/dev/null
nice -n 19 cmake --build --preset fuzz --target cairn_fuzzers
mkdir -p "$FUZZ_FOLDER"
touch "$FUZZ_FOLDER/turns.log"
[ $# -gt 0 ] || set -- $(cd build/fuzz/fuzz && ls | sed -n 's/^fuzz_//p')

# The reader that has had least CPU time, if that is less than what each shall have.
next_reader() {
  printf '%s\n' "$@" | awk -v wanted_s=$((${FUZZ_MIN:-20} * 60)) '
    FILENAME == "-" { cpu_s[$1] += 0; wanted[$1]; next }
    { cpu_s[$2] += $4 }
    END {
      for (name in wanted)
        if (cpu_s[name] < wanted_s && (least == "" || cpu_s[name] < cpu_s[least])) least = name
      print least
    }' - "$FUZZ_FOLDER/turns.log"
}

readers=("$@") status=0
while [ ${#readers[@]} -gt 0 ]; do
  name=$(next_reader "${readers[@]}")
  [ -n "$name" ] || break
  if ! nice -n 19 cmake/fuzz_turn.sh "$name"; then
    status=1
    kept=()
    for reader in "${readers[@]}"; do [ "$reader" = "$name" ] || kept+=("$reader"); done
    readers=("${kept[@]}")
  fi
done
cmake/fuzz_table.sh "$FUZZ_FOLDER/turns.log"
exit $status
