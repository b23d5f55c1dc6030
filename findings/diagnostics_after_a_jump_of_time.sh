#!/usr/bin/env bash
# diagnostic_updater 1.11.0 (Debian 12): after `rosbag play --clock --loop` begins again, a node's diagnostics are silent.
#
# Behaviour: Updater::update(), which a node calls all the time, publishes when ROS time has reached the time of the next
#   message. When simulated time jumps back, that time lies in the future, for as long as the jump was wide. Monitors see
#   a node that died, although it runs. force_update() publishes at any time.
# Source: diagnostic_updater.h, Updater::update(), `if (now_time < next_time_)`.
# Seen: messages published by 100 calls of update() in 10 s of simulated time
#   before the jump from 110 s to 0 s: 10
#   after it: 0
set -euo pipefail
for pinned in libdiagnostic-updater-dev=1.11.0+ds-4+b4 libroscpp-dev=1.15.15+ds-2; do
  [ "$(dpkg-query -W -f='${Version}' "${pinned%%=*}" 2>/dev/null)" = "${pinned#*=}" ] || { echo "needs $pinned"; exit 2; }
done
export PATH=/usr/bin:$PATH ROS_HOSTNAME=localhost
work=$(mktemp -d) port=11811
while (: </dev/tcp/127.0.0.1/$port) 2>/dev/null; do port=$((port + 1)); done
export ROS_MASTER_URI=http://localhost:$port ROS_HOME=$work
rosmaster --core -p $port >"$work/master.log" 2>&1 &
master=$!
trap 'kill $master; wait $master || true; rm -rf "$work"' EXIT
until rosparam list >/dev/null 2>&1; do kill -0 $master; done

cat >"$work/jump.cpp" <<'END'
#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <iostream>
int calls = 0;  // of the task, one for each message
void task(diagnostic_updater::DiagnosticStatusWrapper& status) {
  ++calls;
  status.summary(0, "alive");
}
int main(int argc, char** argv) {
  ros::init(argc, argv, "jump");
  ros::NodeHandle node;
  ros::Time::setNow(ros::Time(100.0));  // simulated time, as a message on /clock sets it
  diagnostic_updater::Updater updater;  // period: 1 s, the default
  updater.setHardwareID("none");
  updater.add("task", task);
  for (double begin : {100.0, 0.0}) {
    calls = 0;
    for (int i = 1; i <= 100; ++i) {
      ros::Time::setNow(ros::Time(begin + 0.1 * i));
      updater.update();
    }
    std::cout << (begin > 0.0 ? "before the jump from 110 s to 0 s: " : "after it: ") << calls << '\n';
  }
}
END
g++ -o "$work/jump" "$work/jump.cpp" $(pkg-config --cflags --libs roscpp)
seen=$("$work/jump")
echo "$seen"
[ "$seen" = "$(sed -n 's/^#   \(before the jump .*\|after it.*\)/\1/p' "$0")" ] || { echo "this is not what was seen before"; exit 1; }
