#!/usr/bin/env bash
# rosconsole 1.14.3 (Debian 12): with use_sim_time and no /clock yet, ROS_WARN_THROTTLE prints nothing at all.
#
# Behaviour: the macro prints when ROS time has reached (time of the last message + period), and the time of the last
#   message begins at 0. Until the first message on /clock, ROS time is 0, too, so that not even the first warning
#   appears. A node that complains in this way of missing input is silent while the bag has not begun, when the complaint
#   would be needed. Plain ROS_WARN prints.
# Source: ros/console.h, ROSCONSOLE_THROTTLE_CHECK and ROS_LOG_THROTTLE.
# Seen: lines printed by 1000 calls with a period of 1 s
#   ROS_WARN_THROTTLE before the first /clock: 0
#   ROS_WARN_THROTTLE at 5 s: 1
#   ROS_WARN before the first /clock: 1000
set -euo pipefail
for pinned in librosconsole-dev=1.14.3-10+b3 libroscpp-dev=1.15.15+ds-2; do
  [ "$(dpkg-query -W -f='${Version}' "${pinned%%=*}" 2>/dev/null)" = "${pinned#*=}" ] || { echo "needs $pinned"; exit 2; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/warn.cpp" <<'END'
#include <ros/ros.h>
void throttled() { ROS_WARN_THROTTLE(1.0, "throttled"); }
int main() {
  ros::Time::init();
  ros::Time::setNow(ros::Time());  // simulated time that has not begun, as with use_sim_time and no /clock
  for (int i = 0; i < 1000; ++i) throttled();
  for (int i = 0; i < 1000; ++i) ROS_WARN("plain");
  ros::Time::setNow(ros::Time(5.0));
  for (int i = 0; i < 1000; ++i) throttled();
}
END
g++ -o "$work/warn" "$work/warn.cpp" $(pkg-config --cflags --libs roscpp)
"$work/warn" >"$work/out" 2>&1
seen="ROS_WARN_THROTTLE before the first /clock: $(sed '/plain/,$d' "$work/out" | grep -c throttled || true)
ROS_WARN_THROTTLE at 5 s: $(sed '1,/plain/d' "$work/out" | grep -c throttled || true)
ROS_WARN before the first /clock: $(grep -c plain "$work/out" || true)"
echo "$seen"
[ "$seen" = "$(sed -n 's/^#   \(ROS_WARN.*: [0-9]*$\)/\1/p' "$0")" ] || { echo "this is not what was seen before"; exit 1; }
