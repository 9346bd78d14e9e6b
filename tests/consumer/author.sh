#!/usr/bin/env bash
# What the author of a module does, from nothing to a mission: author.sh PREFIX KIND FOLDER
# PREFIX holds an installed Cairn; FOLDER is made anew. Says how much machine time each part took.
set -eu
prefix=$1 kind=$2 folder=$3
name=my_$kind
TIMEFORMAT='%U %S'
total_s=0

# part NAME COMMAND...: runs it, quietly unless it fails.
part() {
  local what=$1 used
  shift
  used=$({ time "$@" >part.log 2>&1 || touch failed; } 2>&1 | awk '{print $1 + $2}')
  if [ -e failed ]; then
    cat part.log
    echo "FAILED: $what: $*"
    exit 1
  fi
  total_s=$(awk "BEGIN {print $total_s + $used}")
  echo "machine time: $what $used s"
}

rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
part scaffold "$prefix/bin/cairn" plugins new "$kind" "$name"
part configure cmake -S "$name" -B build -DCMAKE_PREFIX_PATH="$prefix"
part build cmake --build build
grep -i 'warning' part.log && { echo "FAILED: the scaffold builds with warnings"; exit 1; }
part conformance ctest --test-dir build --output-on-failure --no-tests=error
echo "machine time: $kind, scaffold to green conformance $total_s s"
part mission "$prefix/bin/cairn" run "$name/mission.yaml" --plugins build/lib/cairn --out out
part "mission again" env CAIRN_PLUGIN_PATH=build/lib/cairn "$prefix/bin/cairn" run "$name/mission.yaml" --out again
# Every mission saves a map that the program finds sound, and both ways to the module give the same.
part check "$prefix/bin/cairn" map check "out/$name.cairn"
cmp "out/$name.cairn" "again/$name.cairn"
if [ "$kind" = detector ]; then
  "$prefix/bin/cairn" map info "out/$name.cairn" --json | grep -q '"landmarks":1[,}]' ||
    { echo "FAILED: the mission did not find its one thing"; exit 1; }
fi
