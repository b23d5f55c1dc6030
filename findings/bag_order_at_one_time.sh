#!/usr/bin/env bash
# rosbag_storage 1.15.15 (Debian 12): rosbag::View gives messages that were recorded at one time in an order that alternates.
#
# Behaviour: for messages of several topics with the same time, rosbag::View, and so rosbag play, gives the topics in the order
#   of writing, then in the reverse one, and so on. Python's Bag.read_messages() gives always the order of writing. What was
#   recorded as pressures, then pose, is played as pose, then pressures, in every other sample.
# Source: rosbag_storage, View::iterator::increment(): std::sort of the topics by time alone, newest first, after every message.
# Seen: (topics in the order of C++, then of Python)
#   /b /a /a /b /b /a /a /b
#   /a /b /a /b /a /b /a /b
set -euo pipefail
for pinned in librosbag-storage-dev=1.15.15+ds-2 python3-rosbag=1.15.15+ds-2; do
  [ "$(dpkg-query -W -f='${Version}' "${pinned%%=*}" 2>/dev/null)" = "${pinned#*=}" ] || { echo "needs $pinned"; exit 2; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 - "$work/one_time.bag" >"$work/python" <<'END'
import sys
import genpy
import rosbag
from std_msgs.msg import String
with rosbag.Bag(sys.argv[1], "w") as bag:
    for second in range(1, 5):
        for topic in ("/a", "/b"):
            bag.write(topic, String(), genpy.Time(second))
print(*(topic for topic, _, _ in rosbag.Bag(sys.argv[1]).read_messages()))
END
cat >"$work/read.cpp" <<'END'
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <iostream>
int main(int, char** argv) {
  rosbag::Bag bag(argv[1]);
  rosbag::View view(bag);
  const char* space = "";
  for (const rosbag::MessageInstance& message : view) std::cout << space << message.getTopic(), space = " ";
  std::cout << '\n';
}
END
g++ -I/usr/include/pluginlib -I/usr/include/class_loader -I/usr/include/ament_index_cpp -I/usr/include/rcpputils \
  -I/usr/include/rcutils "$work/read.cpp" -o "$work/read" \
  -lrosbag_storage -lroscpp_serialization -lrostime -lcpp_common -lclass_loader
"$work/read" "$work/one_time.bag" >"$work/cpp"
cat "$work/cpp" "$work/python"
[ "$(cat "$work/cpp")" = "/b /a /a /b /b /a /a /b" ] && [ "$(cat "$work/python")" = "/a /b /a /b /a /b /a /b" ]
