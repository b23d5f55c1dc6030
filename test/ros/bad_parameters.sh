#!/usr/bin/env bash
# stiffness_node with bad parameters: one message that lists every fault, exit status 2. BUILD_DIR
set -euo pipefail
build=$1
set +u; source "$build/devel/setup.bash"; set -u
port=11811
while (: </dev/tcp/127.0.0.1/$port) 2>/dev/null; do port=$((port + 1)); done
export ROS_MASTER_URI=http://localhost:$port
rosmaster --core -p $port >"$build/bad_parameters_master.log" 2>&1 &
master=$!
trap 'kill $master 2>/dev/null; wait $master || true' EXIT
until rosparam list >/dev/null 2>&1; do kill -0 $master; done
rosparam set /stiffness_node/pressure_topics "['bad topic!']"
status=0
output=$("$build/devel/lib/live_stiffness/stiffness_node" _model:=best _pressure_unit:=atm _heartbeat_hz:=-1.0 \
  _accuracy:=fine _scene_file:=/nonexistent.yaml 2>&1) || status=$?
echo "$output"
[ $status = 2 ] || { echo "exit status $status, not 2"; exit 1; }
for word in '~model = best' '~pressure_unit = atm' '~heartbeat_hz = -1' '~accuracy' 'bad topic!' '/nonexistent.yaml'; do
  grep -qF -- "$word" <<<"$output" || { echo "not named: $word"; exit 1; }
done
