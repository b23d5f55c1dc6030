#!/usr/bin/env bash
# calibrate and register_recording from the command line, on a table of compliances and on a recording made up here.
set -euo pipefail
calibrate=$1 register=$2 source=$3
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
fail() { echo "$1" >&2; exit 1; }
one=$source/config/scenes/paper_one_segment.yaml

# A table: the calibrated scene is legal, says how it was obtained, and predicts the row better than the start.
printf '%s\n' pressure_{1..6}_pa c{1,2,3}{1,2,3}_m_per_n | paste -sd, >"$dir/table.csv"
echo 90000,90000,90000,90000,90000,90000,0.0885,0,0,0,0.0885,0,0,0,0.0031 >>"$dir/table.csv"
"$calibrate" "$one" --compliance-table "$dir/table.csv" -p youngs_modulus_pa -o "$dir/out.yaml" --rows "$dir/rows.csv" -q >"$dir/report"
grep -q '^youngs_modulus_pa' "$dir/report" || fail "no estimate in the report"
grep -q '^# Calibrated: calibrate ' "$dir/out.yaml" || fail "the scene does not say how it was obtained"
"$calibrate" "$dir/out.yaml" --list | grep -q '^youngs_modulus_pa' || fail "the calibrated scene cannot be read"
awk -F, 'NR == 2 {exit !($2 < 0.05)}' "$dir/rows.csv" || fail "the row is not fitted"

# Names that need quotes in YAML are in the scene that is written, and it loads.
sed 's/name: s1/name: "a #1: [b"/' "$one" >"$dir/names.yaml"
"$calibrate" "$dir/names.yaml" --compliance-table "$dir/table.csv" -p youngs_modulus_pa -o "$dir/out.yaml" -q >"$dir/report"
"$calibrate" "$dir/out.yaml" --list >"$dir/list" || fail "a scene with names in quotes cannot be read"
grep -q 'name: "a #1: \[b"' "$dir/out.yaml" || fail "the name of the segment is another one: $(grep name: "$dir/out.yaml")"

# A recording at rest does not determine the registration: written, with exit status 1 and the reason.
arm=$source/config/scenes/stiff_flop_recorded.yaml
{ echo time_s,pressure_1_pa,pressure_2_pa,pressure_3_pa,tip_x_m,tip_y_m,tip_z_m,tip_qw,tip_qx,tip_qy,tip_qz
  for k in {10..40}; do echo "0.$k,0,0,0,0.0100$k,0.02,0.0585,1,0,0,0"; done; } >"$dir/rest.csv"
status=0
"$register" "$arm" "$dir/rest.csv" "$dir/registration.yaml" >"$dir/verdict" 2>&1 || status=$?
[ $status = 1 ] || fail "register_recording: status $status instead of 1"
grep -q 'NOT determined' "$dir/registration.yaml" || fail "the file does not carry the verdict"
grep -q '^sensor_on_tip' "$dir/registration.yaml" || fail "no registration was written"
"$register" "$arm" "$dir/rest.csv" "$dir/registration.yaml" --fit-delay >"$dir/verdict" 2>&1 || true
grep -q 'tracker delay: NOT determined' "$dir/verdict" || fail "a delay was determined at rest"
! grep -q '^tracker_delay_s' "$dir/registration.yaml" || fail "a delay that is not determined was written"

# A scene too soft for its pressures: calibrate starts from moduli that carry it, register_recording names them. The tip moves
# along z by what the stiffer arm does, so that only the modulus is asked for.
{ head -1 "$dir/rest.csv"
  for k in {100..160}; do
    p=$(((k - 100) * 1000))
    awk -v k=$k -v p=$p 'BEGIN {printf "0.%d,%d,%d,%d,0.01,0.02,%.6f,1,0,0,0\n", k, p, p, p, 0.0585 + 1.2e-7 * p}'
  done; } >"$dir/pushed.csv"
awk '/youngs_modulus_pa/ {sub(/[0-9.e+]+$/, "200.0")} {print}' "$arm" >"$dir/soft.yaml"
"$calibrate" "$dir/soft.yaml" "$dir/pushed.csv" -p youngs_modulus_pa --blocks 0 -o "$dir/carried.yaml" -q >"$dir/report" ||
  fail "calibrate of a soft scene: status $?: $(cat "$dir/report")"
grep -q "with the moduli of the scene.*no equilibrium.*so the fit starts there" "$dir/report" || fail "the moduli are not named"
"$calibrate" "$dir/carried.yaml" "$dir/pushed.csv" -p none --blocks 0 -q >"$dir/report" || true
! grep -q "no equilibrium" "$dir/report" || fail "the calibrated scene does not carry the robot: $(cat "$dir/report")"
status=0
"$register" "$dir/soft.yaml" "$dir/pushed.csv" "$dir/soft_registration.yaml" >"$dir/log" 2>&1 || status=$?
[ $status != 0 ] || fail "register_recording believes a scene that does not carry the robot"
grep -q "carry the robot (youngs_modulus_pa: " "$dir/log" || fail "register_recording does not name the moduli: $(cat "$dir/log")"

# Bounds beyond what a scene may have end there: what is written can be read.
"$calibrate" "$arm" "$dir/pushed.csv" -p creep_share --bounds creep_share=-3:5 --blocks 0 -o "$dir/bounded.yaml" -q \
  >"$dir/report" 2>&1 || true
grep -q "0 to 0.9 is used" "$dir/report" || fail "bounds are not limited: $(cat "$dir/report")"
"$calibrate" "$dir/bounded.yaml" --list >/dev/null || fail "the scene within its bounds cannot be read"

# One registration of two recordings; then the same one given, which is only read.
"$calibrate" "$arm" "$dir/pushed.csv" "$dir/rest.csv" -p none --shared-registration --registration "$dir/shared.yaml" --blocks 0 \
  -q >"$dir/report"
[ "$(grep -c 'registration: ' "$dir/report")" = 2 ] || fail "not one verdict a recording"
[ "$(grep 'registration: ' "$dir/report" | sort -u | wc -l)" = 1 ] || fail "two verdicts on one registration"
cp "$dir/shared.yaml" "$dir/before.yaml"
"$calibrate" "$arm" "$dir/rest.csv" -p none --registration "$dir/shared.yaml" --fixed --blocks 0 -q >"$dir/report"
grep -q 'registration: given' "$dir/report" || fail "a given registration is not said to be"
cmp "$dir/before.yaml" "$dir/shared.yaml" || fail "a given registration was written"

# Where one file cannot be written, the report and the other files are there all the same, with exit status 2.
status=0
"$calibrate" "$arm" "$dir/rest.csv" -p none -o "$dir/none/out.yaml" --registration "$dir/kept.yaml" --residuals "$dir/kept.csv" \
  --blocks 0 -q >"$dir/report" 2>"$dir/log" || status=$?
[ $status = 2 ] || fail "a file that cannot be written: status $status instead of 2"
grep -q 'registration: ' "$dir/report" || fail "what was computed is lost"
grep -q "none/out.yaml" "$dir/log" || fail "the file is not named: $(cat "$dir/log")"
[ -s "$dir/kept.yaml" ] && [ -s "$dir/kept.csv" ] || fail "the other files are not written"

# A YAML file among --parameters is the node's, and no name.
"$calibrate" "$arm" "$dir/rest.csv" -p none node.yaml --blocks 0 -q >"$dir/report" 2>&1 || true
! grep -q "'node.yaml' is none" "$dir/report" || fail "a parameter file counts as a name"

# Faults: one message, status 2, nothing written.
for bad in "-p colour" "--blocks -1 -p none" "--samples some" "--prior youngs_modulus_pa=1" "--loads all" "missing.csv" \
    "--tracker-delay-s 3 -p none" "--force-sensor-channels fx gy -p none" "--force-sensor-sign 0 -p none" \
    "--force-sensor-delay-s nan -p none" "-p force_sensor_height_m" "-p force_sensor_height_m --loads predict" \
    "--fixed -p none" "-p none a.yaml b.yml" "-p force_sensor_mass_kg --loads fit"; do
  status=0
  # shellcheck disable=SC2086
  "$calibrate" "$arm" "$dir/rest.csv" $bad -o "$dir/bad.yaml" -q >"$dir/log" 2>&1 || status=$?
  [ $status = 2 ] || fail "calibrate $bad: status $status instead of 2: $(cat "$dir/log")"
  [ ! -e "$dir/bad.yaml" ] || fail "calibrate $bad wrote a scene"
done
grep -q "must be one of force_sensor_azimuth_deg" "$dir/log" || fail "what may be fitted of a force sensor is not said"
