#!/usr/bin/env bash
# Builds everything and runs all tests; ctest's summary comes last.
#   tools/test.sh [ctest options]                    e.g. tools/test.sh -R materials
set -euo pipefail
cd "$(dirname "$0")/.."

tools/packages.sh program tests
cmake --preset release -DNSFRAME_TESTS=ON > /dev/null
cmake --build build --parallel "$(nproc)"
exec ctest --test-dir build --parallel "$(nproc)" --output-on-failure "$@"
