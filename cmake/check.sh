#!/usr/bin/env bash
# What `make check` runs beside the tests: formatting, clang-tidy, and the unit tests under
# AddressSanitizer and UndefinedBehaviorSanitizer.
set -eu
cd "$(dirname "$0")/.."
jobs=$(nproc)

echo "== clang-format"
git ls-files '*.hpp' '*.cpp' | xargs clang-format --dry-run -Werror

echo "== clang-tidy"
git ls-files 'maps/*.cpp' 'framework/*.cpp' 'plugins/*.cpp' 'planners/*.cpp' |
  xargs -P "$jobs" -n 4 clang-tidy -p build/release --quiet --warnings-as-errors='*' 2>/dev/null

echo "== address and undefined behaviour sanitizers"
cmake --preset asan >/dev/null
cmake --build --preset asan --target all cairn_tests
ASAN_OPTIONS=detect_leaks=1 ctest --test-dir build/asan --output-on-failure -j "$jobs"

echo "== fuzzers of the readers of logs and graphs, a minute each"
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target cairn_fuzzers
for fuzzer in build/fuzz/fuzz/fuzz_*; do
  name=$(basename "$fuzzer" | sed 's/^fuzz_//')
  found=build/fuzz/found/$name
  mkdir -p "$found"
  "$fuzzer" -max_total_time=60 -timeout=10 -rss_limit_mb=2048 -max_len=8192 -verbosity=0 -artifact_prefix="$found/" \
    "$found" "tests/fuzz/corpus/$name"
done
echo "check: all good"
