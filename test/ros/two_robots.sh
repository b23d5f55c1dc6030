#!/usr/bin/env bash
# two_robots.launch: each robot has topics and frames of its own, and what happens to one leaves the other alone; and
# roswtf, who looks at all of it, finds nothing of ours wrong; the running configuration of one can be dumped.
# BUILD_DIR SOURCE_DIR
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

echo "- the running configuration of one is changed, dumped, and that of a third"
dynparam() { rosrun dynamic_reconfigure dynparam "$@"; }
threshold_is() { dynparam get "$1" | grep -q "'update_threshold_pa': $2,"; }  # NODE PA
dynparam set /left/stiffness_node update_threshold_pa 1234.5
threshold_is /right/stiffness_node 1000.0 || fail "right has changed, too"
dynparam dump /left/stiffness_node "$work/left.cfg" && grep -q "update_threshold_pa: 1234.5" "$work/left.cfg" || fail "dynparam dump"
rosparam dump "$work/left.yaml" /left/stiffness_node
rosparam load "$work/left.yaml" /third/stiffness_node
"$programs/stiffness_node" __ns:=/third >"$work/third.log" 2>&1 &
third=$!
pids+=("$third")
within 20 "third is not there" rosservice info /third/stiffness_node/set_parameters
threshold_is /third/stiffness_node 1234.5 || fail "third has not what was dumped"
rosparam dump "$work/third.yaml" /third/stiffness_node
diff "$work/left.yaml" "$work/third.yaml" || fail "third is not configured as left is"
kill -INT $third; wait $third || fail "third: exit status $?"

if command -v rviz >/dev/null && command -v Xvfb >/dev/null; then
  echo "- rviz of each, as the launch file starts it: its topics, its base"
  exec {display}< <(exec Xvfb -displayfd 1 -screen 0 800x600x24 2>"$work/Xvfb.log")
  pids+=($!)
  read -r -t 20 number <&$display || fail "no display"
  export DISPLAY=:$number LIBGL_ALWAYS_SOFTWARE=1
  shows() {  # ROBOT
    local info topic
    info=$(rosnode info "/$1/rviz")
    for topic in markers tip_marker/update; do
      grep -A3 "topic: /$1/stiffness_node/$topic$" <<<"$info" | grep -q "to: /$1/stiffness_node" || return 1
    done
  }
  for robot in left right; do
    command=$(roslaunch --args /$robot/rviz "$source/launch/two_robots.launch" rviz:=true)
    [[ $command == *" -f $robot/base "* ]] || fail "fixed frame of $robot: $command"
    (eval "exec env $command") >"$work/rviz.log" 2>&1 &
    rviz=$!
    pids+=("$rviz")
    within 60 "rviz of $robot does not show it" shows $robot
    kill $rviz; wait $rviz || true
  done
fi

echo "- what happens to one leaves the other alone"
pid=$(rosnode info /left/rig_simulator | sed -n 's/^Pid: //p')
kill -9 "$pid"
within 20 "left is not stale although its rig is dead" is left True
is right False || fail "right is stale because the rig of left is dead"
kill -INT $launch; wait $launch || fail "roslaunch: exit status $?"
