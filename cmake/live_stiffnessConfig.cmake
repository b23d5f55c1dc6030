# Read by find_package(live_stiffness) where the package is installed without ROS; variables as in catkin's file.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
find_dependency(yaml-cpp)
include(${CMAKE_CURRENT_LIST_DIR}/live_stiffnessTargets.cmake)
set(live_stiffness_LIBRARIES live_stiffness_core live_stiffness_parallel)
set(live_stiffness_INCLUDE_DIRS "")  # the targets have them
