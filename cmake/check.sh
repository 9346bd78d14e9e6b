#!/usr/bin/env bash
# What `make check` runs beside the tests: formatting, clang-tidy, whether benches and each header alone compile, all tests
# under AddressSanitizer and UndefinedBehaviorSanitizer, those with threads under ThreadSanitizer, and the fuzzers.
set -eu
cd "$(dirname "$0")/.."
jobs=$(nproc)

echo "== clang-format"
git ls-files '*.hpp' '*.cpp' | xargs clang-format --dry-run -Werror

echo "== clang-tidy"
# Twelve sources at once, as the release build compiles them: most of its time goes to the headers that they share. That
# they are included is then no fault; that no source includes another is looked at by itself.
if git grep -n '#include ".*[.]cpp"' -- maps framework plugins planners; then exit 1; fi
cmake --preset tidy >/dev/null  # nothing is built but generated headers
if ninja -C build/tidy -t query ros2_messages >/dev/null 2>&1; then ninja -C build/tidy ros2_messages >/dev/null; fi
sed -n "s|^ *\"file\": \"\($PWD.*\)\",\{0,1\}$|\1|p" build/tidy/compile_commands.json |
  grep -E "^$PWD/(build/tidy/)?(maps|framework|plugins|planners)/.*[.]c(pp|xx)$" | sort -u |
  xargs -P "$jobs" -n 1 clang-tidy -p build/tidy --config-file=.clang-tidy --checks=-bugprone-suspicious-include \
    --quiet --warnings-as-errors='*' >build/clang-tidy.log 2>&1 ||
  { grep -A 4 "error:" build/clang-tidy.log | head -n 40; exit 1; }

echo "== benches and every header alone, compiled only"
cmake --build --preset release --target cairn_benches headers_compile_alone

echo "== address and undefined behaviour sanitizers"
cmake/sanitized_tests.sh

echo "== thread sanitizer"
cmake/thread_sanitized_tests.sh

echo "== fuzzers of all readers, ${FUZZ_S:-60} s each"
cmake/fuzz.sh
echo "check: all good"
