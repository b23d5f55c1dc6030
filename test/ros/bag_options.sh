#!/usr/bin/env bash
# register_recording, calibrate and estimate_wrench of a bag with a rig's own topics, absolute pressures in kPa and
# positions in mm say the same as of the bag it was made from.
# BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1 source=$2 programs=$1/devel/lib/live_stiffness
set +u; source "$build/devel/setup.bash"; set -u
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
fail() { echo "failed: $1" >&2; exit 1; }
scene=$source/config/scenes/stiff_flop_recorded.yaml

"$programs/simulate_bag" "$scene" "$dir/plain.bag" --channels 3 --program random_walk --seconds 60 --amplitude-pa 60000 \
  --push-n 0.2 0 0 --registration "$source/config/registrations/simulated_rig.yaml" >"$dir/log" 2>&1 || fail "$(cat "$dir/log")"
/usr/bin/python3 - "$dir" <<'EOF'
import sys
import rosbag
from geometry_msgs.msg import PoseStamped, WrenchStamped
from std_msgs.msg import Float64MultiArray

ATMOSPHERE_PA = 101325.0
with rosbag.Bag(sys.argv[1] + "/plain.bag") as plain, rosbag.Bag(sys.argv[1] + "/own.bag", "w") as own:
    for topic, message, time in plain.read_messages():
        if topic.endswith("chamber_pressures"):
            own.write("/valves/measured", Float64MultiArray(data=[(p + ATMOSPHERE_PA) * 1e-3 for p in message.pressure]), time)
        elif topic.endswith("aurora_pose"):
            moved = PoseStamped(header=message.header, pose=message.pose)
            for axis in "xyz":
                setattr(moved.pose.position, axis, 1e3 * getattr(moved.pose.position, axis))
            own.write("/ndi/tip", moved, time)
        elif topic.endswith("tip_force_torque"):
            own.write("/ati/raw", WrenchStamped(header=message.header, wrench=message.wrench), time)
EOF
own=(--pressures /valves/measured --pose /ndi/tip --tip-wrench /ati/raw --pressure-unit kPa --pressure-reference absolute --position-unit mm)

# same WHAT A B: files whose lines hold the same numbers, to 1e-6 of the largest of a line (names, comments and times apart): far
# below what any unit taken wrongly would do, far above the rounding of units that iterations carry on.
same() {
  /usr/bin/python3 - "$@" <<'EOF' || fail "$1 differs"
import re
import sys

NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")
a, b = (re.sub(r"(own|plain)\.\w+|--\S+|/\w+/\w+|; [\d.]+ s$", "", open(path).read(), flags=re.M).splitlines() for path in sys.argv[2:])
if len(a) != len(b) or len(a) < 2:
    sys.exit("%d and %d lines" % (len(a), len(b)))
for one, other in zip(a, b):
    if one.startswith("#"):
        continue
    x, y = ([float(n) for n in NUMBER.findall(line)] for line in (one, other))
    scale = max(map(abs, x + [1e-3]))
    if len(x) != len(y) or any(abs(p - q) > 1e-6 * scale for p, q in zip(x, y)):
        sys.exit(one + "\n" + other)
EOF
}

for bag in plain own; do
  options=()
  [ $bag = plain ] || options=("${own[@]}")
  "$programs/register_recording" "$scene" "$dir/$bag.bag" "$dir/$bag.yaml" --samples all "${options[@]}" \
    >"$dir/$bag.register" 2>&1 || fail "register_recording: $(cat "$dir/$bag.register")"
  "$programs/estimate_wrench" "$scene" "$dir/$bag.bag" --registration "$dir/$bag.yaml" -o "$dir/$bag.csv" "${options[@]}" \
    >"$dir/$bag.estimate" 2>&1 || fail "estimate_wrench: $(cat "$dir/$bag.estimate")"
  "$programs/calibrate" "$scene" "$dir/$bag.bag" -p youngs_modulus_pa -q "${options[@]}" \
    >"$dir/$bag.calibrate" 2>&1 || fail "calibrate: $(cat "$dir/$bag.calibrate")"
done
same "the registration" "$dir/plain.yaml" "$dir/own.yaml"
same "the estimated wrench" "$dir/plain.csv" "$dir/own.csv"
same "the calibration" "$dir/plain.calibrate" "$dir/own.calibrate"
grep -q youngs_modulus_pa "$dir/own.calibrate" || fail "nothing was calibrated"

# Without the options there is nothing to read, and the message says which topics there are.
status=0
"$programs/register_recording" "$scene" "$dir/own.bag" "$dir/none.yaml" >"$dir/log" 2>&1 || status=$?
[ $status = 2 ] || fail "register_recording without options: status $status instead of 2"
grep -q chamber_pressures "$dir/log" || fail "the missing topic is not named: $(cat "$dir/log")"
[ ! -e "$dir/none.yaml" ] || fail "a registration was written"
status=0
"$programs/calibrate" "$scene" "$dir/own.bag" -p youngs_modulus_pa --pressure-unit atm >"$dir/log" 2>&1 || status=$?
[ $status = 2 ] && grep -q "must be" "$dir/log" || fail "a unit that is not known: status $status, $(cat "$dir/log")"

# A bag that was cut off, and one of a recorder that was killed: one line with file, reason and way out, which is one.
/usr/bin/python3 - "$dir" <<'EOF'
import os
import sys
import rosbag

killed = rosbag.Bag(sys.argv[1] + "/killed.bag", "w", chunk_threshold=20000)
with rosbag.Bag(sys.argv[1] + "/plain.bag") as plain:
    for topic, message, time in plain.read_messages():
        killed.write(topic, message, time)
killed._file.flush()
os._exit(0)
EOF
head -c 50000 "$dir/killed.bag" >"$dir/cut.bag"
for bag in killed cut; do
  for command in "replay $dir/$bag.bag --scene $scene" "register_recording $scene $dir/$bag.bag $dir/none.yaml"; do
    status=0
    $programs/$command >"$dir/log" 2>&1 || status=$?
    [ $status = 2 ] || fail "$command: status $status instead of 2"
    grep -c "bag $dir/$bag.bag: cannot be read: .*\`rosbag reindex $dir/$bag.bag\`" "$dir/log" | grep -qx 1 || fail "$command: $(cat "$dir/log")"
    [ ! -e "$dir/$bag.estimates.bag" ] && [ ! -e "$dir/none.yaml" ] || fail "$command: something was written"
  done
  rosbag reindex "$dir/$bag.bag" >"$dir/log" 2>&1 || fail "rosbag reindex: $(cat "$dir/log")"
  "$programs/replay" "$dir/$bag.bag" --scene "$scene" --channel-of-chamber 0 0 1 1 2 2 >"$dir/log" 2>&1 || fail "replay of a reindexed bag: $(cat "$dir/log")"
done
