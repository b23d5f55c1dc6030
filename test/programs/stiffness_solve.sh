#!/usr/bin/env bash
# stiffness_solve as a user runs it: columns, statuses, messages, exit status. PROGRAM SOURCE_DIR
set -euo pipefail
program=$1 scene=$2/config/scenes/paper_one_segment.yaml
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1"; cat "$work"/*; exit 1; }
# solve TABLE [OPTION...]: sets status. Not at the end of a pipe, where it could not.
solve() { local table=$1; shift; status=0; printf '%b' "$table" | "$program" "$scene" "$@" >"$work/out" 2>"$work/err" || status=$?; }

# Good rows, with a wrench: exit 0, the columns promised, 17 digits, and the push shows.
solve 'p_1_pa,p_2_pa,p_3_pa,p_4_pa,p_5_pa,p_6_pa,fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm\n6e4,6e4,0,0,0,0,0,0,0,0,0,0\n6e4,6e4,0,0,0,0,0.1,0,0,0,0,0\n' 
[ $status = 0 ] || fail "exit status $status of a good table"
[ "$(head -1 "$work/out" | cut -d, -f1-12)" = status,iterations,solve_us,x_m,y_m,z_m,qw,qx,qy,qz,c_11,c_12 ] || fail header
[ "$(head -1 "$work/out" | cut -d, -f46-47,82)" = c_66,material_11,material_66 ] || fail "last columns"
awk -F, 'NF != 82 {exit 1}' "$work/out" || fail "not 82 columns"
awk -F, 'NR == 2 {free = $4} NR == 3 {exit !($4 - free > 0.001)}' "$work/out" || fail "0.1 N along x moves the tip by more than 1 mm"
sed -n 2p "$work/out" | cut -d, -f4 | grep -qE '^-0\.0[0-9]{16,18}$' || fail "17 significant digits"

# Bad rows keep their place, the others are solved, messages name the line: exit 1.
solve 'p_1_pa,p_2_pa,p_3_pa,p_4_pa,p_5_pa,p_6_pa\n6e4,6e4,0,0,0,0\n1,2\n\nnan,0,0,0,0,0\n9e5,9e5,9e5,9e5,9e5,9e5\nx,0,0,0,0,0\n0,0,0,0,0,0\n' 
[ $status = 1 ] || fail "exit status $status of a table with bad rows"
[ "$(tail -n +2 "$work/out" | cut -d, -f1 | tr '\n' ' ')" = "ok invalid_input invalid_input out_of_range invalid_input ok " ] || fail statuses
for line in 3 5 6 7; do grep -q "^line $line: " "$work/err" || fail "no message for line $line"; done
grep -qi nan "$work/out" && fail "NaN in the output"

# A table from a spreadsheet: the same numbers, and a row of units is said.
columns='p_1_pa;p_2_pa;p_3_pa;p_4_pa;p_5_pa;p_6_pa'
solve 'p_1_pa,p_2_pa,p_3_pa,p_4_pa,p_5_pa,p_6_pa\n60000.5,0,0,0,0,0\n'
cut -d, -f1,2,4- "$work/out" >"$work/plain"
solve '\xEF\xBB\xBF'"$columns"';\r\nPa;Pa;Pa;Pa;Pa;Pa;\r\n60000,5;0;0;0;0;0;\r\n'
[ $status = 0 ] && cut -d, -f1,2,4- "$work/out" | cmp - "$work/plain" || fail "a table from a spreadsheet"
grep -q "^line 2 has no number and is taken as a row of units" "$work/err" || fail "the row of units is not said"
solve "$columns"'\nkPa;;;;;\n60;0;0;0;0;0\n'
[ $status = 2 ] && grep -q "column p_1_pa has 'kPa' in the row of units" "$work/err" || fail "units that contradict the name"

# The four models and their contradictions; PCC ignores the weight, so its compliance is that of the closed form.
for model in lpcc npcc lcm ncm; do
  solve 'p_1_pa,p_2_pa,p_3_pa,p_4_pa,p_5_pa,p_6_pa\n9e4,9e4,0,0,0,0\n' --model $model
  [ $status = 0 ] || fail "model $model"
  sed -n 2p "$work/out" | cut -d, -f2,4 >"$work/$model"
done
[ "$(cut -d, -f1 "$work/lpcc" "$work/npcc" | sort -u)" = 0 ] || fail "PCC must take the closed form"
[ "$(cat "$work"/{lpcc,npcc,lcm,ncm} | sort -u | wc -l)" = 4 ] || fail "four models must give four answers"

# Stations: that at the end of the only segment is the tip. Deflection: the exponential from the tangent is exact to
# first order, so that at 1e-4 N (a motion of some 3e-6 m) it misses by much less than the motion.
solve 'p_1_pa,p_2_pa,p_3_pa,p_4_pa,p_5_pa,p_6_pa,fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm\n9e4,9e4,0,0,0,0,1e-4,0,0,0,0,0\n' \
  --stations 0.5,1 --deflection
[ $status = 0 ] || fail "stations and deflection"
[ "$(head -1 "$work/out" | cut -d, -f83,90,126,168,169,180)" = \
  s1_0.5_x_m,s1_0.5_material_11,s1_1_x_m,s1_1_material_66,tangent_linear_x_m,material_exponential_z_m ] || fail "further columns"
sed -n 2p "$work/out" | awk -F, '
  function near(a, b, e) {return (a - b) ^ 2 < e * e}
  {exit !(NF == 180 && near($4, $126, 1e-12) && near($6, $128, 1e-12) && near($47, $133, 1e-9) && $90 < 0.5 * $133 &&
          near($4, $172, 1e-8) && near($6, $174, 1e-8))}' || fail "values of stations and deflection"
solve '' --stations 0.5,1.5
[ $status = 2 ] && grep -q "stations = 0.5,1.5: must be" "$work/err" || fail "bad stations"
solve '' --model lcm --stepping continuous
[ $status = 2 ] && grep -q contradicts "$work/err" || fail "contradiction"
solve 'p_1_pa\n'
[ $status = 2 ] && grep -q "p_6_pa is missing" "$work/err" || fail "missing columns"
# A scene alone is described, and so it is if asked; doubts are warnings beside a table.
solve ''
[ $status = 0 ] && grep -q "the arm stands" "$work/out" && grep -q "^No doubts" "$work/out" || fail "description"
solve 'p_1_pa\n' --describe
[ $status = 0 ] && grep -q "^buckling" "$work/out" || fail "--describe"
[ ! -s "$work/err" ] || fail "doubts about a good scene"
good=$scene scene=$work/kpa.yaml
sed 's/youngs_modulus_pa: 90060.0/youngs_modulus_pa: 90.06/' "$good" >"$scene"
solve 'p_1_pa,p_2_pa,p_3_pa,p_4_pa,p_5_pa,p_6_pa\n0,0,0,0,0,0\n' 
[ "$(grep -c 'warning: scene .*youngs_modulus_pa = 90.06.*kPa, write 90060' "$work/err")" = 1 ] || fail "no doubt about E in kPa"
grep -q youngs "$work/out" && fail "a doubt in the table"
solve ''
[ $status = 0 ] && grep -q "  - .*kPa, write 90060" "$work/out" || fail "no doubt in the description"

# Names that need quotes, merge keys.
scene=$work/merge.yaml
printf 'all: &all {length_m: 0.06, outer_radius_m: 0.015, chamber_azimuths_deg: [], youngs_modulus_pa: 1.0e5, poissons_ratio: 0.5}
chain: [segment: {<<: *all, name: "#1"}, segment: {<<: *all, name: "a: b"}]\n' >"$scene"
solve ''
[ $status = 0 ] && grep -q "lengths     120 mm: #1 60, a: b 60" "$work/out" || fail "merge keys"
scene=/nonexistent.yaml
solve ''
[ $status = 2 ] && grep -q "cannot be read" "$work/err" || fail "missing scene"
scene=$work
solve ''
[ $status = 2 ] && grep -q "it is a folder; must be the path of a file" "$work/err" || fail "a folder as scene"
"$program" --help | tr -s ' \n' ' ' | grep "One of lpcc, npcc, lcm, ncm" >/dev/null || fail "--help names no choices"
echo ok
