#!/usr/bin/env bash
# Launch files: without a scene they say which argument is missing, what `rosparam dump` saved starts the same robot again,
# nothing of an earlier start stays, frame_prefix leaves the tracker alone; a nodelet says why it was not loaded.
# BUILD_DIR SOURCE_DIR
source "$2/test/support/ros_script.sh"

scenes=$source/config/scenes
launch() {  # FILE [ARGUMENT...]
  roslaunch -p $port "$source/launch/$1" "${@:2}" >"$work/$1.log" 2>&1 &
  launch=$!
  pids+=("$launch")
}
stop() { kill -INT $launch; wait $launch || fail "roslaunch: exit status $?"; }
is_there() { rosservice info "$1/set_parameters"; }
says() { grep -qF -- "$2" "$work/$1.log"; }  # LOG TEXT
value() { rosparam get "/stiffness_node/$1" 2>/dev/null || echo none; }

rosmaster --core -p $port >"$work/master.log" 2>&1 &
pids+=($!)
within 20 "no master" rosparam list
rosrun rosout rosout >"$work/rosout_node.log" 2>&1 &  # before roslaunch, which would end its own with the first launch file
pids+=($!)

echo "- without a scene"
for file in stiffness.launch parallel.launch; do
  launch $file
  within 30 "$file does not name its argument" says $file "~scene_file is missing: must be the path of a scene; launch files take it as scene:="
  stop
done

echo "- a dump starts the same robot again; parameters of an earlier start are forgotten"
launch stiffness.launch "scene:=$scenes/paper_two_segments.yaml" channels:='[0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]' \
  "registration:=$source/config/registrations/simulated_rig.yaml" frame_prefix:=left/
within 30 "no node" is_there /stiffness_node
[ "$(value base_frame) $(value tip_frame) $(value tracker_frame) $(value sensor_frame)" = "left/base left/tip aurora aurora_tip" ] ||
  fail "frame_prefix: $(rosparam get /stiffness_node)"
rosrun dynamic_reconfigure dynparam set /stiffness_node accuracy 1e-6
rosparam dump "$work/first.yaml" /stiffness_node
stop
rosparam set /stiffness_node/pressure_reference absolute
launch stiffness.launch parameters:="$work/first.yaml"
within 30 "no node from the dump" is_there /stiffness_node
rosparam dump "$work/second.yaml" /stiffness_node
stop
diff "$work/first.yaml" "$work/second.yaml" || fail "it is not configured as it was"
says stiffness.launch "2 segment(s), 12 chamber(s) on 6 channel(s)" || fail "another robot"

if ! rospack find nodelet >/dev/null 2>&1; then exit 0; fi
echo "- a nodelet is the same robot, too; its manager says why it does not load another"
# Under a sanitizer the manager, which is not built with it, needs its runtime first: scripts/test says how.
${NODELET_PREFIX:-} rosrun nodelet nodelet manager __name:=lab >"$work/lab.log" 2>&1 &
pids+=($!)
launch nodelet.launch manager:=lab parameters:="$work/first.yaml"
within 30 "no nodelet from the dump" is_there /stiffness_node
rosparam dump "$work/third.yaml" /stiffness_node
stop
diff "$work/first.yaml" "$work/third.yaml" || fail "the nodelet is not configured as the node was"

within 20 "no /rosout" sh -c "rosnode info /lab | grep -q 'to: /rosout'"
stdbuf -oL rostopic echo /rosout_agg >"$work/rosout.log" 2>&1 &
pids+=($!)
within 20 "nobody hears /rosout_agg" sh -c "rosnode info /rosout | grep -q 'to: /rostopic'"
printf 'chain: [{segment: {length_m: -1.0}}]\n' >"$work/faulty.yaml"
launch nodelet.launch manager:=lab "scene:=$work/faulty.yaml"
for place in lab rosout; do
  for fault in "length_m = -1" "youngs_modulus_pa is missing"; do
    within 30 "not in $place: $fault" says $place "$fault"
  done
done
stop
