#!/usr/bin/env bash
# Builds everything and runs all tests; ctest's summary comes last.
#   tools/test.sh [ctest options]                    e.g. tools/test.sh -R materials
set -euo pipefail
cd "$(dirname "$0")/.."

tools/packages.sh program tests
# a first build is a whole one: several sources at once take a third of the time
whole=(); [ -f build/CMakeCache.txt ] || whole=(-DNSFRAME_UNITY=ON)
cmake --preset release -DNSFRAME_TESTS=ON "${whole[@]}" > /dev/null
cmake --build build --parallel "$(nproc)"
exec ctest --test-dir build --parallel "$(nproc)" --output-on-failure "$@"
