#!/usr/bin/env bash
# Nodes with bad parameters: one message that lists every fault, exit status 2. BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1 scenes=$2/config/scenes
set +u; source "$build/devel/setup.bash"; set -u
port=11811
while (: </dev/tcp/127.0.0.1/$port) 2>/dev/null; do port=$((port + 1)); done
export ROS_MASTER_URI=http://localhost:$port
rosmaster --core -p $port >"$build/bad_parameters_master.log" 2>&1 &
master=$!
trap 'kill $master 2>/dev/null; wait $master || true' EXIT
until rosparam list >/dev/null 2>&1; do kill -0 $master; done

# refuses NODE WORD... -- ARGUMENT...: the node exits with status 2 and names every word.
refuses() {
  local node=$1 words=() output status=0 word
  shift
  while [ "$1" != -- ]; do words+=("$1"); shift; done
  shift
  output=$("$build/devel/lib/live_stiffness/$node" "$@" 2>&1) || status=$?
  echo "$output"
  [ $status = 2 ] || { echo "$node: exit status $status, not 2"; exit 1; }
  for word in "${words[@]}"; do
    grep -qF -- "$word" <<<"$output" || { echo "$node: not named: $word"; exit 1; }
  done
}

rosparam set /stiffness_node/pressure_topics "['bad topic!']"
refuses stiffness_node '~model = best' '~pressure_unit = atm' '~heartbeat_hz = -1' '~accuracy' 'bad topic!' \
  '/nonexistent.yaml' '~tip_handle_force_n_per_m = 0' '~show_eigenscrews' -- _model:=best _pressure_unit:=atm \
  _heartbeat_hz:=-1.0 _accuracy:=fine _scene_file:=/nonexistent.yaml _tip_handle_force_n_per_m:=0.0 \
  _show_eigenscrews:=maybe
refuses parallel_node '~length_unit = inch' '~length_timeout_s = 0' 'kind = serial' 'two different names' -- \
  _length_unit:=inch _length_timeout_s:=0.0 _platform_frame:=base _scene_file:="$scenes/paper_one_segment.yaml"
refuses parallel_rig '~period_s = -1' '~height_m' 'scene_file is missing' -- _period_s:=-1.0 _height_m:=high
rosparam set /rig_simulator/contact_force_n '[0.3, 0.1]'
refuses rig_simulator '~program = square' '~seed = 1.5: must be a whole number' '~contact_force_n has 2' \
  '~contact_ramp_s = 3' '~rotation_noise_deg = 30' 'scene_file is missing' -- _program:=square _seed:=1.5 \
  _contact_ramp_s:=3.0 _rotation_noise_deg:=30.0
refuses stiffness_node 'kind = parallel' 'parallel_node' -- _scene_file:="$scenes/stewart_gough.yaml"
