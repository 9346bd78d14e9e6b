#!/usr/bin/env bash
# The whole test suite under AddressSanitizer and UndefinedBehaviorSanitizer, with standard containers that check their
# indices (preset `asan`). Continuous integration and `make check` run it after the tests themselves.
set -eu
cd "$(dirname "$0")/.."
cmake --preset asan >/dev/null
cmake --build --preset asan --target all cairn_tests
ctest --test-dir build/asan --output-on-failure -j "$(nproc)"
cmake/test_cases.sh build/asan
