#!/usr/bin/env bash
# Installs and runs from there: stiffness_solve, examples/, and the demo's launch file. BUILD_DIR
set -euo pipefail
build=$1
# catkin fixes the prefix when it configures, so it cannot be chosen here; scripts/build puts it inside the build.
prefix=$(sed -n 's/^CMAKE_INSTALL_PREFIX:PATH=//p' "$build/CMakeCache.txt")
case "$prefix" in
  "$build"/*) ;;
  *) echo "skipped: would install to $prefix; configure with -DCMAKE_INSTALL_PREFIX=$build/install"; exit 77 ;;
esac
rm -rf "$prefix"
launch=""
# It must not stay: roslaunch would find every launch file of the package twice, here and in the source.
trap '[ -z "$launch" ] || { kill -INT $launch 2>/dev/null; wait $launch; } || true; rm -rf "$prefix"' EXIT
cmake --install "$build" >"$build/install.log"
# A shell that knows nothing of the build.
clean=(env -i HOME="$HOME" PATH=/usr/bin:/bin ROS_HOSTNAME=localhost)
run() { "${clean[@]}" ROS_MASTER_URI="${ROS_MASTER_URI:-}" bash -c "source '$prefix/setup.bash' && $1"; }
scene=$prefix/share/live_stiffness/config/scenes/paper_one_segment.yaml
rows=$(printf 'p_1_pa,p_2_pa,p_3_pa,p_4_pa,p_5_pa,p_6_pa\n6e4,6e4,0,0,0,0\n' |
  run "rosrun live_stiffness stiffness_solve '$scene'" | grep -c '^ok,')
[ "$rows" = 1 ] || { echo "stiffness_solve of the install space solved $rows rows"; exit 1; }
if run "ldd '$prefix/lib/live_stiffness/stiffness_node'" | grep "$build/devel"; then echo "it links the build space"; exit 1; fi
if ! grep -q '^SANITIZER:STRING=.' "$build/CMakeCache.txt"; then  # an example would need the sanitizer's library, too
  run "'$(realpath "$(dirname "$0")")/installed_example.sh' '$prefix'"
fi

port=11911
while (: </dev/tcp/127.0.0.1/$port) 2>/dev/null; do port=$((port + 1)); done
export ROS_MASTER_URI=http://localhost:$port
# Not through run(): the process in the background must be roslaunch itself, so that the trap ends it.
"${clean[@]}" bash -c "source '$prefix/setup.bash' && exec roslaunch -p $port live_stiffness demo.launch" \
  >"$build/install_launch.log" 2>&1 &
launch=$!
for _ in $(seq 12); do
  status=$(run "timeout 5 rostopic echo -n 1 /stiffness_node/estimate/status" 2>"$build/install_echo.log") || true
  [ "${status%%[^0-9]*}" = 0 ] && exit 0
done
echo "no estimate from the install space; rostopic said:"
cat "$build/install_echo.log" "$build/install_launch.log"
exit 1
