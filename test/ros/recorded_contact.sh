#!/usr/bin/env bash
# The recording with pushes through converter, registration, bag and node. recorded_contact.sh BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1 source=$2
recording=${LIVE_STIFFNESS_DATA:-$source/../shared/data}/stiff_flop_recordings/load_1.csv
if [ ! -r "$recording" ]; then
  echo "skipped: $recording is absent (set LIVE_STIFFNESS_DATA)"
  exit 77
fi
set +u; source "$build/devel/setup.bash"; set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
programs=$build/devel/lib/live_stiffness
# Fitted to no_load alone; of load_1 only where base and sensor are, at rest and untouched, and how late the tracker is.
scene=$source/config/scenes/stiff_flop_calibrated.yaml
"$programs/recording_to_bag" "$recording" "$work/load_1.bag"
"$programs/register_recording" "$scene" "$recording" "$work/registration.yaml" --samples quasi_static --fit-delay
rostest --results-filename=recorded_load_1.xml "$source/test/ros/contact_replay.test" bag:="$work/load_1.bag" \
  scene:="$scene" registration:="$work/registration.yaml" name:=recorded_load_1
