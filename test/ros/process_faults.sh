#!/usr/bin/env bash
# Faults of processes, each with real nodes: a publisher is killed and comes back under another name or with another type,
# signals, the master goes away, kill -9 and a lost master under respawn. BUILD_DIR SOURCE_DIR
# Times are printed, not asserted: a busy machine has its own.
source "$2/test/support/ros_script.sh"

start_master() {
  rosmaster --core -p $port >>"$work/master.log" 2>&1 &
  master=$!
  pids+=("$master")
  within 20 "no master" rosparam list
}
start_rig() {  # NAME
  "$programs/rig_simulator" "__name:=$1" "_scene_file:=$scene" >>"$work/$1.log" 2>&1 &
  rig=$!
  pids+=("$rig")
}
scene=$source/config/scenes/paper_one_segment.yaml
is_fresh() { timeout 10 rostopic echo -n 1 /stiffness_node/estimate/stale | grep -q False; }
is_stale() { timeout 10 rostopic echo -n 1 /stiffness_node/estimate/stale | grep -q True; }

start_master
"$programs/stiffness_node" "_scene_file:=$scene" >"$work/node.log" 2>&1 &
node=$!
pids+=("$node")
start_rig rig_a
within 20 "no fresh estimate" is_fresh

echo "- a publisher is killed and comes back under another name"
kill -9 $rig
within 20 "pressures of a publisher that was killed are not stale" is_stale
start_rig rig_b
begin=$(now)
within 20 "the publisher that came back is not heard" is_fresh
echo "  heard after $(since "$begin")"

# A publisher that was killed is taken to be coming back, with the same type, until the master forgets it.
forget_killed() { echo y | rosnode cleanup >>"$work/cleanup.log" 2>&1; }
echo "- a publisher is killed and forgotten, another comes with messages of another type, and then the first type again"
kill -9 $rig
within 20 "pressures of a publisher that was killed are not stale" is_stale
forget_killed
rostopic pub -r 40 /chamber_pressures std_msgs/Float64MultiArray "data: [50000.0, 50000.0, 0.0, 0.0, 10000.0, 10000.0]" \
  >"$work/array.log" 2>&1 &
array=$!
pids+=("$array")
within 20 "pressures of another type are not heard" is_fresh
within 20 "other pressures than were sent" \
  sh -c "timeout 10 rostopic echo -n 1 /stiffness_node/estimate/pressure | grep -q 50000"
kill -9 $array
within 20 "pressures of a publisher that was killed are not stale" is_stale
forget_killed
start_rig rig_b
within 20 "pressures of the first type are not heard any more" is_fresh

for signal in INT TERM; do
  echo "- SIG$signal"
  begin=$(now)
  kill -$signal $node
  status=0; wait $node || status=$?
  echo "  ended with status $status after $(since "$begin")"
  [ $status = 0 ] || fail "exit status $status"
  ! rosnode list | grep -q '^/stiffness_node$' || fail "it is still registered at the master"
  "$programs/stiffness_node" "_scene_file:=$scene" >"$work/node.log" 2>&1 &
  node=$!
  pids+=("$node")
  within 20 "no fresh estimate" is_fresh
done
echo "- the master is killed: the node says so, and goes on"
begin=$(now)
kill -9 $master; wait $master 2>/dev/null || true
within 30 "the log does not say that the master is gone" grep -q "master at .* cannot be reached for 1[0-9] s" "$work/node.log"
echo "  said after $(since "$begin")"
kill -0 $node || fail "the node ended"
begin=$(now)
kill -TERM $node
status=0; wait $node || status=$?
echo "  without a master it ends with status $status after $(since "$begin")"
[ $status = 0 ] || fail "exit status $status"
kill $rig; wait $rig || true

echo "- kill -9 under respawn"
start_master
roslaunch -p $port "$source/launch/demo.launch" respawn:=true >"$work/roslaunch.log" 2>&1 &
launch=$!
pids+=("$launch")
pid_of() { rosnode info "/$1" 2>/dev/null | sed -n 's/^Pid: //p'; }
within 30 "no fresh estimate" is_fresh
old=$(pid_of stiffness_node)
[ -n "$old" ] || fail "no pid of the node"
kill -9 "$old"
begin=$(now)
is_another() { local new; new=$(pid_of stiffness_node); [ -n "$new" ] && [ "$new" != "$old" ]; }
within 20 "it does not come back" is_another
within 20 "it came back without estimates" is_fresh
echo "  first fresh estimate seen after $(since "$begin"), two command line tools included"

echo "- the master is killed and comes back under respawn, its parameters with it"
rosparam dump "$work/parameters.yaml"
# The rig of the launch file will not be known to the new master. Two of one name would end each other.
old_rig=$(pid_of rig_simulator)
[ -n "$old_rig" ] || fail "no pid of the rig"
kill -9 $master; wait $master 2>/dev/null || true
within 30 "the node does not end with status 3" grep -q "stiffness_node.*exit code 3" "$work/roslaunch.log"
start_master
rosparam load "$work/parameters.yaml"
within 30 "the node does not come back" rosnode ping -c 1 /stiffness_node
kill "$old_rig"
within 20 "the old rig does not end" bash -c "! kill -0 $old_rig"
start_rig rig_simulator
within 30 "no fresh estimate by way of the new master" is_fresh
kill $rig; wait $rig || true
kill -INT $launch; wait $launch || fail "roslaunch: exit status $?"
