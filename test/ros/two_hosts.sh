#!/usr/bin/env bash
# Two hosts, as network namespaces joined by a cable: master, rig and node on one, a subscriber on the other, each with
# ROS_IP as docs/tutorial.md has it. BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1 source=$2
name=ls$$
if ! ip netns add ${name}a 2>/dev/null; then
  echo "skipped: ip netns is not permitted here (needs root)"
  exit 77
fi
work=$(mktemp -d)
pids=()
cleanup() {
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  wait || true
  ip netns del ${name}a; ip netns del ${name}b 2>/dev/null || true
  rm -rf "$work"
}
trap cleanup EXIT
ip netns add ${name}b
if ! ip netns exec ${name}a true; then
  echo "skipped: ip netns exec does not work here, as in a chroot whose root is no mount point"
  exit 77
fi
if ! ip link add ${name}x netns ${name}a type veth peer name ${name}y netns ${name}b; then
  echo "skipped: this kernel has no veth"
  exit 77
fi
ip -n ${name}a addr add 10.219.7.1/24 dev ${name}x
ip -n ${name}b addr add 10.219.7.2/24 dev ${name}y
for side in a b; do ip -n $name$side link set lo up; done
ip -n ${name}a link set ${name}x up
ip -n ${name}b link set ${name}y up
set +u; source "$build/devel/setup.bash"; set -u
unset ROS_HOSTNAME
export ROS_MASTER_URI=http://10.219.7.1:11311
host() { echo "ip netns exec $name$1 env ROS_IP=10.219.7.$([ "$1" = a ] && echo 1 || echo 2)"; }
on() { $(host "$1") "${@:2}"; }  # a|b COMMAND...
start() { exec $(host "$1") "${@:2}"; }  # the same with &: what $! names is the command itself, and can be killed
fail() { echo "failed: $1"; tail -n 20 "$work"/*.log; exit 1; }
scene=$source/config/scenes/paper_one_segment.yaml programs=$build/devel/lib/live_stiffness
start a rosmaster --core -p 11311 >"$work/master.log" 2>&1 & pids+=($!)
end=$((SECONDS + 20))
until on b rosparam list >/dev/null 2>&1; do [ $SECONDS -lt $end ] || fail "no master seen from the other host"; sleep 0.05; done
start a "$programs/rig_simulator" "_scene_file:=$scene" >"$work/rig.log" 2>&1 & pids+=($!)
start a "$programs/stiffness_node" "_scene_file:=$scene" >"$work/node.log" 2>&1 & pids+=($!)
end=$((SECONDS + 30))
until on b timeout 10 rostopic echo -n 1 /stiffness_node/estimate/stale 2>/dev/null | grep -q False; do
  [ $SECONDS -lt $end ] || fail "no fresh estimate reaches the other host"
done
echo "a fresh estimate crossed the cable"
answer=$(on b rosservice call /stiffness_node/compliance_at '{segment: 0, fraction: 1.0}') || true
grep -q 'success: True' <<<"$answer" || fail "a service cannot be called from the other host: $answer"
echo "and a service was called over it"
