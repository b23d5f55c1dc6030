# Headers of others, parsed once for many sources: a build would spend most of its time there. Every source still includes
# what it uses, and builds without (-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON, as scripts/test --debug does).

# add_precompiled_headers(NAME HEADER...): an object library ${PROJECT_NAME}_NAME with them, whose flags have to be those of
# the targets that use it.
function(add_precompiled_headers name)
  set(target ${PROJECT_NAME}_${name})
  set(empty ${PROJECT_BINARY_DIR}/${target}.cpp)
  file(GENERATE OUTPUT ${empty} CONTENT "")
  add_library(${target} OBJECT ${empty})
  target_precompile_headers(${target} PRIVATE ${ARGN})
  target_include_directories(${target} SYSTEM PRIVATE ${EIGEN3_INCLUDE_DIRS} ${catkin_INCLUDE_DIRS})
  if(catkin_EXPORTED_TARGETS)
    add_dependencies(${target} ${catkin_EXPORTED_TARGETS})
  endif()
endfunction()

# use_precompiled_headers(NAME TARGET...)
function(use_precompiled_headers name)
  foreach(target ${ARGN})
    target_precompile_headers(${target} REUSE_FROM ${PROJECT_NAME}_${name})
  endforeach()
endfunction()

set(core_headers <Eigen/Dense> <algorithm> <cmath> <cstdio> <deque> <fstream> <functional> <iostream> <limits> <map> <memory>
  <mutex> <optional> <set> <sstream> <stdexcept> <string> <vector>)
# Not those that leave work to the end of every source, as diagnostic_updater and tf2_ros do.
set(ros_headers ${core_headers} <geometry_msgs/PoseStamped.h> <ros/ros.h> <visualization_msgs/MarkerArray.h>)
