#!/usr/bin/env bash
# A real recording through the whole chain: converter, bag, node. recorded_replay.sh BUILD_DIR SOURCE_DIR NAME
set -euo pipefail
build=$1 source=$2 name=$3
recording=${LIVE_STIFFNESS_DATA:-$source/../shared/data}/stiff_flop_recordings/$name.csv
if [ ! -r "$recording" ]; then
  echo "skipped: $recording is absent (set LIVE_STIFFNESS_DATA)"
  exit 77
fi
set +u; source "$build/devel/setup.bash"; set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
scene=$source/config/scenes/stiff_flop_recorded.yaml
"$build/devel/lib/live_stiffness/recording_to_bag" "$recording" "$work/$name.bag" \
  --scene "$scene" --registration "$work/registration.yaml"
# The hand-tuned scene: mean tip error over all samples below 1.5 mm.
rostest --results-filename="$name.xml" "$source/test/ros/replay.test" bag:="$work/$name.bag" scene:="$scene" \
  registration:="$work/registration.yaml" speed:="${REPLAY_SPEED:-5}" name:="recorded_$name" max_mean_error_m:=0.0015
