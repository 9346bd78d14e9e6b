#!/usr/bin/env bash
# What `make check` runs beside the tests: formatting, clang-tidy, whether benches and each header alone compile, all tests
# under AddressSanitizer and UndefinedBehaviorSanitizer, those with threads under ThreadSanitizer, and the fuzzers.
set -eu
cd "$(dirname "$0")/.."
jobs=$(nproc)

echo "== clang-format"
git ls-files '*.hpp' '*.cpp' | xargs clang-format --dry-run -Werror

echo "== clang-tidy"
cmake --preset tidy >/dev/null  # not built: it lists every file alone, where the release build takes many together
git ls-files 'maps/*.cpp' 'framework/*.cpp' 'plugins/*.cpp' 'planners/*.cpp' |
  xargs -P "$jobs" -n 4 clang-tidy -p build/tidy --quiet --warnings-as-errors='*' 2>build/clang-tidy.log ||
  { tail -n 20 build/clang-tidy.log; exit 1; }

echo "== benches and every header alone, compiled only"
cmake --build --preset release --target cairn_benches headers_compile_alone

echo "== address and undefined behaviour sanitizers"
cmake/sanitized_tests.sh

echo "== thread sanitizer"
cmake/thread_sanitized_tests.sh

echo "== fuzzers of all readers, ${FUZZ_S:-60} s each"
cmake/fuzz.sh
echo "check: all good"
