#!/usr/bin/env bash
# The tests in which threads meet, under ThreadSanitizer (preset `tsan`; tests/threads/CMakeLists.txt lists them).
# Continuous integration and `make check` run it after the address-sanitized tests.
set -eu
cd "$(dirname "$0")/.."
cmake --preset tsan >/dev/null
cmake --build --preset tsan --target cairn_thread_tests
# ThreadSanitizer of clang 14 does not start where addresses are too random; `setarch -R` makes them fixed, if it may.
fixed=$(setarch -R true 2>/dev/null && echo "setarch -R" || true)
$fixed ctest --test-dir build/tsan -L threads --output-on-failure -j "$(nproc)"
cmake/test_cases.sh build/tsan
