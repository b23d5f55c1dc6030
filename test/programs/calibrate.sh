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
  for k in {10..40}; do echo "0.$k,0,0,0,0.01,0.02,0.0585,1,0,0,0"; done; } >"$dir/rest.csv"
status=0
"$register" "$arm" "$dir/rest.csv" "$dir/registration.yaml" >"$dir/verdict" 2>&1 || status=$?
[ $status = 1 ] || fail "register_recording: status $status instead of 1"
grep -q 'NOT determined' "$dir/registration.yaml" || fail "the file does not carry the verdict"
grep -q '^sensor_on_tip' "$dir/registration.yaml" || fail "no registration was written"
"$register" "$arm" "$dir/rest.csv" "$dir/registration.yaml" --fit-delay >"$dir/verdict" 2>&1 || true
grep -q 'tracker delay: NOT determined' "$dir/verdict" || fail "a delay was determined at rest"
! grep -q '^tracker_delay_s' "$dir/registration.yaml" || fail "a delay that is not determined was written"

# Faults: one message, status 2, nothing written.
for bad in "-p colour" "--blocks -1 -p none" "--samples some" "--prior youngs_modulus_pa=1" "--loads all" "missing.csv" \
    "--tracker-delay-s 3 -p none" "--force-sensor-channels fx gy -p none" "--force-sensor-sign 0 -p none" \
    "--force-sensor-delay-s nan -p none" "-p force_sensor_height_m" "-p force_sensor_height_m --loads predict" \
    "-p force_sensor_mass_kg --loads fit"; do
  status=0
  # shellcheck disable=SC2086
  "$calibrate" "$arm" "$dir/rest.csv" $bad -o "$dir/bad.yaml" -q >"$dir/log" 2>&1 || status=$?
  [ $status = 2 ] || fail "calibrate $bad: status $status instead of 2: $(cat "$dir/log")"
  [ ! -e "$dir/bad.yaml" ] || fail "calibrate $bad wrote a scene"
done
grep -q "must be one of force_sensor_azimuth_deg" "$dir/log" || fail "what may be fitted of a force sensor is not said"
