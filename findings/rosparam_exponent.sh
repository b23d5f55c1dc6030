#!/usr/bin/env bash
# rosparam 1.15.15 with PyYAML 6.0 (Debian 12): 1e-9 in a parameter file becomes text, and roscpp then takes the default.
#
# Behaviour: rosparam reads YAML with PyYAML, which follows YAML 1.1: a floating point number has a decimal point, and its
#   exponent has a sign. `1e-9` and `120.0e3` are therefore text, `1.0e-9` and `120.0e+3` are numbers. In YAML 1.2, and for
#   yaml-cpp, all four are numbers. ros::NodeHandle::param<double>() finds a parameter of another type, returns the
#   default, and says nothing.
# Source: python3-yaml, yaml/resolver.py, implicit resolver of tag:yaml.org,2002:float; roscpp, NodeHandle::param().
# Seen: (name, type at the parameter server, what param<double>(name, -1) returns)
#   point_and_sign double 1e-09
#   no_point string -1
#   no_sign string -1
set -euo pipefail
for pinned in python3-rosparam=1.15.15+ds-2 python3-yaml=6.0-3+b2 libroscpp-dev=1.15.15+ds-2; do
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

printf 'point_and_sign: 1.0e-9\nno_point: 1e-9\nno_sign: 120.0e3\n' >"$work/parameters.yaml"
rosparam load "$work/parameters.yaml"
cat >"$work/read.cpp" <<'END'
#include <ros/ros.h>
#include <iostream>
int main(int argc, char** argv) {
  ros::init(argc, argv, "read");
  ros::NodeHandle node;
  for (const char* name : {"point_and_sign", "no_point", "no_sign"}) {
    XmlRpc::XmlRpcValue value;
    node.getParam(name, value);
    const bool is_text = value.getType() == XmlRpc::XmlRpcValue::TypeString;
    std::cout << name << (is_text ? " string " : " double ") << node.param<double>(name, -1.0) << '\n';
  }
}
END
g++ -o "$work/read" "$work/read.cpp" $(pkg-config --cflags --libs roscpp)
seen=$("$work/read")
echo "$seen"
[ "$seen" = "$(sed -n 's/^#   \([a-z_]* \(double\|string\) .*\)/\1/p' "$0")" ] || { echo "this is not what was seen before"; exit 1; }
