#!/usr/bin/env bash
# The test suite under AddressSanitizer and UndefinedBehaviorSanitizer, with standard containers that check their indices
# (preset `asan`): all of it, as `make check` runs it, or with `foundation` what tests/CMakeLists.txt calls so, as
# continuous integration does after the tests themselves.
set -eu
cd "$(dirname "$0")/.."
cmake --preset asan >/dev/null
if [ "${1:-}" = foundation ]; then
  cmake --build --preset asan --target cairn_foundation_tests
  ctest --test-dir build/asan -L foundation --output-on-failure -j "$(nproc)"
else
  cmake --build --preset asan --target all cairn_tests
  ctest --test-dir build/asan --output-on-failure -j "$(nproc)"
fi
cmake/test_cases.sh build/asan
