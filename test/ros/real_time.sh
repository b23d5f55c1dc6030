#!/usr/bin/env bash
# ~realtime_priority and ~lock_memory with the real node: in force where the system permits them, else a warning that says
# the way out, and a node that works. At the fastest heartbeat, which leaves its inputs a millisecond to connect.
# BUILD_DIR SOURCE_DIR
source "$2/test/support/ros_script.sh"

scene=$source/config/scenes/paper_one_segment.yaml
rosmaster --core -p $port >"$work/master.log" 2>&1 &
pids+=($!)
within 20 "no master" rosparam list
"$programs/rig_simulator" "_scene_file:=$scene" >"$work/rig.log" 2>&1 &
pids+=($!)

start_node() {  # LOG COMMAND...
  local log=$1
  shift
  "$@" "$programs/stiffness_node" "_scene_file:=$scene" _realtime_priority:=20 _lock_memory:=true \
    _heartbeat_hz:=1000 >"$work/$log" 2>&1 &
  node=$!
  pids+=("$node")
  within 20 "no fresh estimate" sh -c "timeout 10 rostopic echo -n 1 /stiffness_node/estimate/stale | grep -q False"
}
end_node() {
  kill -INT $node
  wait $node || fail "the node did not end well"
}

echo "- not permitted"
deny=()
[ "$(id -u)" != 0 ] || deny=(setpriv --bounding-set=-sys_nice,-ipc_lock --inh-caps=-sys_nice,-ipc_lock)
start_node denied.log prlimit --rtprio=0:0 --memlock=65536:65536 "${deny[@]}"
grep -q "realtime_priority = 20 is not permitted.*rtprio 20" "$work/denied.log" || fail "no warning of the priority"
locks=true
[ -z "${ASAN_OPTIONS:-}" ] || locks=false  # sanitizers make mlockall() do nothing
! $locks || grep -q "memory cannot be locked, going on without" "$work/denied.log" || fail "no warning of the memory"
end_node

if ! chrt -f 20 true 2>/dev/null || [ "$(id -u)" != 0 ]; then
  echo "skipped: permitted (this user may not)"
  exit 0
fi
echo "- permitted"
start_node permitted.log
! grep -qE "not permitted|cannot be locked" "$work/permitted.log" || fail "a warning although it is permitted"
thread=$(grep -l '^live_estimate$' /proc/$node/task/*/comm | cut -d / -f 5)
chrt -p "$thread" | grep -q "SCHED_FIFO" || fail "estimates are not made under SCHED_FIFO"
thread=$(grep -l '^live_drawing$' /proc/$node/task/*/comm | cut -d / -f 5)
chrt -p "$thread" | grep -q "SCHED_OTHER" || fail "markers are not drawn in a thread of their own, that is not real-time"
! $locks || [ "$(awk '/VmLck/ { print $2 }' /proc/$node/status)" -gt 0 ] || fail "nothing is locked in memory"
end_node
