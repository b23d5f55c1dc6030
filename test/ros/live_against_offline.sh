#!/usr/bin/env bash
# The inputs of test/cases/make_cases.py, and a recorded one where there is data, played into a real node and given to replay:
# both say the same. BUILD_DIR SOURCE_DIR [NAME...]
source "$2/test/support/ros_script.sh"

"$source/test/cases/simulate.sh" "$programs" "$source" "$work/sim.bag"
recorded=()
recording=${LIVE_STIFFNESS_DATA:-$source/../shared/data}/stiff_flop_recordings/no_load.csv
if [ -r "$recording" ]; then
  scene=$source/config/scenes/stiff_flop_recorded.yaml
  "$programs/recording_to_bag" "$recording" "$work/recorded.bag" --scene "$scene" --registration "$work/registration.yaml" \
    >"$work/convert.log" 2>&1 || fail "recording_to_bag"
  printf 'scene_file: %s\nregistration_file: %s\nchannel_of_chamber: [0, 0, 1, 1, 2, 2]\n' "$scene" "$work/registration.yaml" \
    >"$work/recorded.yaml"
  recorded=("$work/recorded.bag" "$work/recorded.yaml")
fi
mkdir "$work/cases"
/usr/bin/python3 "$source/test/cases/make_cases.py" "$work/cases" "$work/sim.bag" "${recorded[@]}"

roscore -p "$port" >"$work/roscore.log" 2>&1 &
pids+=($!)
within 20 "no master" rosparam list
/usr/bin/python3 "$source/test/cases/live_against_offline.py" "$programs" "$work/cases" "${@:3}"
