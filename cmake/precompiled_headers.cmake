# Headers of others, parsed once for many sources: a build would spend most of its time there. Every source still includes
# what it uses, and builds without (-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON, as scripts/test --debug does).

# add_precompiled_headers(NAME HEADER...): an object library NAME with them, whose flags are those of the targets that use it.
function(add_precompiled_headers name)
  set(empty ${PROJECT_BINARY_DIR}/${name}.cpp)
  file(GENERATE OUTPUT ${empty} CONTENT "")
  add_library(${name} OBJECT ${empty})
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

# use_precompiled_headers(NAME TARGET...)
function(use_precompiled_headers name)
  foreach(target ${ARGN})
    target_precompile_headers(${target} REUSE_FROM ${name})
  endforeach()
endfunction()

set(core_headers <Eigen/Dense> <algorithm> <cmath> <cstdio> <deque> <fstream> <functional> <iostream> <limits> <map> <memory>
  <mutex> <optional> <set> <sstream> <stdexcept> <string> <vector>)
# Not those that leave work to the end of every source, as diagnostic_updater and tf2_ros do.
set(ros_headers ${core_headers} <geometry_msgs/PoseStamped.h> <ros/ros.h> <visualization_msgs/MarkerArray.h>)
