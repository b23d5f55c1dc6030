#!/bin/sh
# Usage: core_links_no_ros.sh LIBRARY. Fails if the built core library needs a ROS library or a symbol of one.
library=$1
if [ ! -f "$library" ]; then
  echo "FAILED: no library at '$library'; build the target live_stiffness_core first"
  exit 1
fi
symbols=$(nm -C "$library" 2>/dev/null) || { echo "FAILED: nm cannot read $library"; exit 1; }
if ! echo "$symbols" | grep -q 'live_stiffness::'; then
  echo "FAILED: $library defines nothing of live_stiffness; is it the core library?"
  exit 1
fi
ros_libraries='libros|libtf2|libxmlrpcpp|libtopic_tools|libcpp_common'
needed=$(readelf -d "$library" 2>/dev/null | grep NEEDED | grep -E "$ros_libraries")
used=$(echo "$symbols" | grep -E '^ *U (ros|tf2|rosbag|topic_tools)[a-z0-9_]*::')
if [ -n "$needed$used" ]; then
  echo "FAILED: the core library $library must build without ROS, but it needs"
  echo "$needed$used"
  echo "Move what uses ROS to src/ros, which is not part of the core."
  exit 1
fi
echo "$library needs no ROS"
