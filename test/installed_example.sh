#!/usr/bin/env bash
# Builds examples/ against an installed package and compares what it prints with stiffness_solve. PREFIX
set -euo pipefail
prefix=$1
examples=$(cd "$(dirname "$0")/../examples" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
scene=$prefix/share/live_stiffness/config/scenes/paper_one_segment.yaml
if ! { cmake -S "$examples" -B "$work" -DCMAKE_PREFIX_PATH="$prefix" && cmake --build "$work"; } >"$work/log" 2>&1; then
  cat "$work/log"
  exit 1
fi
export LD_LIBRARY_PATH=$prefix/lib
"$work/solve" "$scene" >"$work/printed"
printf 'p_1_pa,p_2_pa,p_3_pa,p_4_pa,p_5_pa,p_6_pa\n6e4,6e4,0,0,0,0\n' |
  "$prefix/lib/live_stiffness/stiffness_solve" "$scene" >"$work/table.csv"
# The last 36 words printed are the compliance, row by row, with six digits; columns c_11 to c_66 of the table.
awk -F, 'NR == FNR { n = split($0, words, " "); for (i = 1; i <= n; ++i) printed[++count] = words[i]; next }
         FNR == 1 { for (i = 1; i <= NF; ++i) if ($i == "c_11") first = i; next }
         { for (i = 0; i < 36; ++i) {
             difference = printed[count - 35 + i] - $(first + i)
             allowed = 1e-5 * $(first + i)
             if (difference * difference > allowed * allowed + 1e-18) { print "entry " i ": " printed[count - 35 + i] " and " $(first + i); exit 1 } }
           compared = 1 }
         END { exit !compared }' "$work/printed" "$work/table.csv" || { cat "$work/printed"; exit 1; }
