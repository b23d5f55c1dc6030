#!/usr/bin/env bash
# stiffness_map as a user runs it: table, statuses, the search, messages, exit status. PROGRAM SOURCE_DIR
set -euo pipefail
program=$1 scenes=$2/config/scenes
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1"; head -50 "$work"/*; exit 1; }
map() { status=0; "$program" "$@" >"$work/out" 2>"$work/err" || status=$?; }
one=$scenes/paper_one_segment.yaml two=$scenes/paper_two_segments.yaml

# A grid with failing corners: every row there, in order, with its status.
map "$one" --channels 3 --pressures 0:4e5:4
[ $status = 0 ] || fail "exit status $status of a grid"
[ "$(head -1 "$work/out" | cut -d, -f1,6-8,14,15,21)" = p_1_pa,p_6_pa,status,x_m,qz,eta_1_n,tau_n ] || fail header
[ "$(wc -l <"$work/out")" = 65 ] || fail "64 rows"
awk -F, 'NF != 21 {exit 1}' "$work/out" || fail "21 columns"
awk -F, 'NR == 3 {exit !($4 == 0 && $5 > 133333 && $5 < 133334 && $6 == $5)}' "$work/out" || fail "last channel fastest, fed in pairs"
grep -q ',out_of_range,,,,,,,,,,,,,,$' "$work/out" || fail "a failed row has empty fields"
grep -qi nan "$work/out" && fail "NaN in the table"
grep -q '64 configurations, .* us each' "$work/err" || fail rate

# A sample: the seed decides, the number of threads does not.
map "$one" --channels 3 --pressures 0:1e5 --random 500 --seed 3 --threads 1 --criterion directional:1,1,0; cp "$work/out" "$work/first"
map "$one" --channels 3 --pressures 0:1e5 --random 500 --seed 3 --threads 2 --criterion directional:1,1,0
cmp "$work/first" "$work/out" || fail "threads change the table"
head -1 "$work/out" | grep -q tau_n_per_m || fail unit
map "$one" --channels 3 --pressures 0:1e5 --random 500 --seed 4
cmp -s "$work/first" "$work/out" && fail "the seed changes nothing"

# The search.
map "$two" --channels 6 --find stiffest --direction x --at 0.01,0.005,0.095 --starts 4 --max-bar 1 --tolerance-mm 0.1
[ $status = 0 ] && grep -q "^reached: true" "$work/out" && grep -q stiffest_over_softest "$work/out" || fail "search"
map "$one" --channels 3 --find softest --direction 0,0,1 --at 0,0,1 --starts 2
[ $status = 1 ] && grep -q "out of reach" "$work/out" && grep -q "^nearest" "$work/out" || fail "out of reach"

# Bad input: exit 2, and the message names the option.
bad() { local word=$1; shift; map "$@"; [ $status = 2 ] && grep -q -- "$word" "$work/err" || fail "bad input $*"; }
bad "either --pressures or --find" "$one"
bad "pressures = 1:2" "$one" --pressures 1:2
bad "pressures = 0:1e5:0" "$one" --pressures 0:1e5:0
bad "criterion = stiff" "$one" --pressures 0:1e5:3 --criterion stiff
bad "find = x" "$one" --find x --at 0,0,0
bad "at = (missing)" "$one" --find softest
bad "max-bar = -1" "$one" --find softest --at 0,0,0 --max-bar -1
bad "random = 0" "$one" --pressures 0:1e5 --random 0
bad "must be finite\|must be >=" "$one" --pressures=-9e9:1e5:3
bad "multiple\|chambers" "$one" --channels 4 --pressures 0:1e5:3
bad "chambers" "$two" --channel-of-chamber 0,0,1,1,2,2 --pressures 0:1e5:3
bad "cannot be read" /nonexistent.yaml --pressures 0:1e5:3
bad "cannot be written" "$one" --pressures 0:1e5:1 -o /nonexistent/map.csv
map --help
[ $status = 0 ] && grep -q "stiffest|softest" "$work/out" || fail help
echo ok
