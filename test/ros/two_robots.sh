#!/usr/bin/env bash
# two_robots.launch: each robot has topics and frames of its own, and what happens to one leaves the other alone; and
# roswtf, who looks at all of it, finds nothing of ours wrong. BUILD_DIR SOURCE_DIR
source "$2/test/support/ros_script.sh"

echo_one() { timeout 10 rostopic echo -n 1 "$1"; }
is() { echo_one "/$1/stiffness_node/estimate/stale" | grep -q "$2"; }  # ROBOT True|False

roslaunch -p $port "$source/launch/two_robots.launch" >"$work/roslaunch.log" 2>&1 &
launch=$!
pids+=("$launch")
for robot in left right; do
  within 40 "no fresh estimate of $robot" is $robot False
  echo_one "/$robot/stiffness_node/estimate/header/frame_id" | grep -q "$robot/base" || fail "frame of $robot"
done
left=$(echo_one /left/stiffness_node/estimate/pressure | tr -cd , | wc -c)
right=$(echo_one /right/stiffness_node/estimate/pressure | tr -cd , | wc -c)
[ "$left $right" = "5 11" ] || fail "commas between pressures: $left and $right, not those of 6 and 12 chambers"

echo "- topics: shared are only those that ROS shares"
shared=$(rostopic list | grep -vE '^/(left|right)/' | sort | xargs)
[ "$shared" = "/diagnostics /rosout /rosout_agg /tf /tf_static" ] || [ "$shared" = "/diagnostics /rosout /rosout_agg /tf" ] ||
  [ "$shared" = "/diagnostics /rosout /tf /tf_static" ] || fail "shared topics: $shared"
for robot in left right; do
  other=$([ $robot = left ] && echo right || echo left)
  ! rosnode info "/$robot/stiffness_node" | grep -q "/$other/" || fail "$robot is connected to $other"
done

echo "- frames"
frames=$( (timeout 20 rostopic echo -n 60 /tf; timeout 10 rostopic echo -n 2 /tf_static) |
  sed -n 's/.*frame_id: "\(.*\)"/\1/p' | sort -u | xargs)
echo "  $frames"
for frame in $frames; do
  [[ $frame =~ ^(left|right)/ ]] || fail "frame $frame belongs to neither"
done
[[ $frames == *left/tip* && $frames == *right/tip* ]] || fail "frames: $frames"

if command -v roswtf >/dev/null; then
  echo "- roswtf"
  mkdir "$work/ros"  # Debian sets no ROS_ROOT, which roswtf cannot do without
  ROS_ROOT=${ROS_ROOT:-$work/ros} roswtf >"$work/roswtf.log" 2>&1 || true
  sed -i 's/\x1b\[[0-9;]*m//g' "$work/roswtf.log"
  cat "$work/roswtf.log"
  grep -qE "^No errors or warnings|^Found [0-9]+ " "$work/roswtf.log" || fail "roswtf did not look"
  ! grep -E "^ERROR" "$work/roswtf.log" || fail "roswtf finds errors"
  # Inputs that need not be there: a known wrench, and rviz's answers to the handle.
  others=$(grep -E '^ +\* .*[^:]$' "$work/roswtf.log" | grep -E '/left/|/right/' | grep -vE '/tip_wrench$|/tip_marker/feedback$' || true)
  [ -z "$others" ] || fail "roswtf warns of: $others"
  others=$(grep -E "^WARNING" "$work/roswtf.log" | grep -vE "subscriptions are unconnected|unexpectedly connected|[Rr]os ?[Dd]ep|ROS Dep" || true)
  [ -z "$others" ] || fail "roswtf: $others"
fi

echo "- what happens to one leaves the other alone"
pid=$(rosnode info /left/rig_simulator | sed -n 's/^Pid: //p')
kill -9 "$pid"
within 20 "left is not stale although its rig is dead" is left True
is right False || fail "right is stale because the rig of left is dead"
kill -INT $launch; wait $launch || fail "roslaunch: exit status $?"
