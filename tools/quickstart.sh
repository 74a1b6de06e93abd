#!/usr/bin/env bash
# From a fresh Debian 12 machine to a result: packages, build, run of examples/two_story.
#   tools/quickstart.sh [EXAMPLE]                    default: two_story
set -euo pipefail
cd "$(dirname "$0")/.."

example=${1:-two_story}
scene=examples/$example/scene.toml
results=results/$example
if [ ! -f "$scene" ]; then
  echo "quickstart.sh: no example '$example'; there are: $(cd examples && ls -d -- */ | tr -d / | tr '\n' ' ')" >&2
  exit 2
fi

tools/packages.sh program png
echo "Building nsframe (build/) ..."
# a first build is a whole one: several sources at once take a third of the time
whole=(); [ -f build/CMakeCache.txt ] || whole=(-DNSFRAME_UNITY=ON)
cmake --preset release -DNSFRAME_TESTS=OFF "${whole[@]}" > /dev/null
cmake --build build --target nsframe --parallel "$(nproc)"
echo "Running $scene ..."
build/nsframe run "$scene" -o "$results"
