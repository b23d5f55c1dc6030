#!/usr/bin/env bash
# parallel_solve as a user runs it: columns, statuses, messages, exit status. PROGRAM SOURCE_DIR STIFFNESS_SOLVE
set -euo pipefail
program=$1 scenes=$2/config/scenes serial_program=$3
scene=$scenes/stewart_gough.yaml
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1"; cat "$work"/*; exit 1; }
# solve TABLE [OPTION...]: sets status. Not at the end of a pipe, where it could not.
solve() { local table=$1; shift; status=0; printf '%b' "$table" | "$program" "$scene" "$@" >"$work/out" 2>"$work/err" || status=$?; }
lengths=l_1_m,l_2_m,l_3_m,l_4_m,l_5_m,l_6_m

# Good rows, with a wrench: exit 0, the columns of stiffness_solve, and the push shows.
solve "$lengths,fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm\n.41,.41,.41,.41,.41,.41,0,0,0,0,0,0\n.41,.41,.41,.41,.41,.41,1,0,0,0,0,0\n"
[ $status = 0 ] || fail "exit status $status of a good table"
[ "$(head -1 "$work/out" | cut -d, -f1-12)" = status,iterations,solve_us,x_m,y_m,z_m,qw,qx,qy,qz,c_11,c_12 ] || fail header
[ "$(head -1 "$work/out" | cut -d, -f46-47,82)" = c_66,material_11,material_66 ] || fail "last columns"
awk -F, 'NF != 82 {exit 1}' "$work/out" || fail "not 82 columns"
awk -F, 'NR == 2 {free = $4} NR == 3 {exit !($4 - free > 1e-4)}' "$work/out" || fail "1 N along x moves the platform by more than 0.1 mm"

# Bad rows keep their place, the others are solved, messages name the line: exit 1.
solve "$lengths\n.41,.41,.41,.41,.41,.41\n1,2\n\nnan,.4,.4,.4,.4,.4\n410,410,410,410,410,-1\nx,0,0,0,0,0\n.4,.41,.4,.41,.4,.41\n"
[ $status = 1 ] || fail "exit status $status of a table with bad rows"
[ "$(tail -n +2 "$work/out" | cut -d, -f1 | tr '\n' ' ')" = "ok invalid_input invalid_input invalid_input invalid_input ok " ] || fail statuses
for line in 3 5 6 7; do grep -q "^line $line: " "$work/err" || fail "no message for line $line"; done
grep -qi nan "$work/out" && fail "NaN in the output"

# There and back: the lengths of a pose lead to that pose.
solve "x_m,y_m,z_m,qw,qx,qy,qz\n.05,0,.4,1,0,0,0\n0,0,.4,2,0,0,0\n" --inverse
[ $status = 1 ] || fail "exit status $status of --inverse with a bad quaternion"
[ "$(head -1 "$work/out" | cut -d, -f83-88)" = $lengths ] || fail "columns of --inverse"
awk -F, 'NF != 88 {exit 1}' "$work/out" || fail "not 88 columns"
solve "$lengths\n$(sed -n 2p "$work/out" | cut -d, -f83-88)\n"
awk -F, 'NR == 2 {exit !($1 == "ok" && $4 > 0.05 - 1e-9 && $4 < 0.05 + 1e-9 && $6 > 0.4 - 1e-9 && $6 < 0.4 + 1e-9)}' "$work/out" || fail "not back at the pose"

# Points: the rods of the scene start at radius 0.073 m in the base, and end there, turned, at a straight platform.
solve "x_m,y_m,z_m,qw,qx,qy,qz\n0,0,.4,1,0,0,0\n" --inverse --points 3
[ "$(head -1 "$work/out" | cut -d, -f89,142)" = r1_1_x_m,r6_3_z_m ] || fail "columns of --points"
sed -n 2p "$work/out" | awk -F, '{r1 = sqrt($89 ^ 2 + $90 ^ 2); r3 = sqrt($95 ^ 2 + $96 ^ 2); exit !(NF == 142 &&
  (r1 - 0.073) ^ 2 < 1e-18 && $91 == 0 && (r3 - 0.073) ^ 2 < 1e-18 && ($97 - 0.4) ^ 2 < 1e-18 && $94 > 0.15 && $94 < 0.25)}' ||
  fail "points of a rod"
solve "$lengths\n.4,.41,.4,.41,.4,.41\n" --points 1
[ $status = 2 ] && grep -q "points = 1: must be" "$work/err" || fail "bad points"

solve 'l_1_m,colour\n'
[ $status = 2 ] && grep -q "l_6_m is missing" "$work/err" && grep -q "column colour: unknown" "$work/err" || fail "bad header"
"$program" --help | grep -q "l_1_m,...,l_N_m" || fail help

# Scenes of the other kind are refused by name, both ways.
scene=$scenes/paper_one_segment.yaml
solve ''
[ $status = 2 ] && grep -q "kind = serial: must be parallel here" "$work/err" || fail "serial scene"
status=0; "$serial_program" "$scenes/stewart_gough.yaml" </dev/null >"$work/out" 2>"$work/err" || status=$?
[ $status = 2 ] && grep -q "kind = parallel: must be serial here" "$work/err" || fail "parallel scene"
echo ok
