#!/usr/bin/env bash
# Instructions a step of the two-story pairs, counted by valgrind: free of the noise of clocks, so that two commits can be
# compared. Run from 2.4 s to 2.6 s of the record, over the first impacts; a difference of two runs, so that set-up,
# gravity and modes drop out. Valgrind shows the program AVX2 at most.
#   bench/callgrind.sh [program]                     default: build/nsframe
set -euo pipefail
cd "$(dirname "$0")/.."

program=${1:-build/nsframe}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

instructions() { # example, duration [s], further options
  local example=$1 duration=$2
  shift 2
  valgrind --tool=callgrind --callgrind-out-file="$folder/profile" "$program" run "examples/$example/scene.toml" -q \
    -o "$folder/run" --set output.frames=0 --set 'output.history=[]' --set analysis.dt=0.001 \
    --set "analysis.duration=$duration" "$@" > "$folder/log" 2>&1 || { cat "$folder/log" >&2; return 1; }
  sed -n 's/^\(summary\|totals\): \([0-9]*\).*/\2/p' "$folder/profile" | tail -1
}

row() { # title, example, further options
  local title=$1 example=$2 first last
  shift 2
  first=$(instructions "$example" 2.4 "$@")
  last=$(instructions "$example" 2.6 "$@")
  printf '| %-32s | %12d |\n' "$title" $(((last - first) / 200))
}

printf '| %-32s | %12s |\n' "pair" "instructions"
printf '|%s|%s|\n' ---------------------------------- --------------
row "elastic" two_story_elastic
row "displacement-based, Steel02" two_story --set structure.left.columns.element=displacement \
  --set structure.right.columns.element=displacement
row "force-based, Steel02" two_story
