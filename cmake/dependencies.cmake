# Libraries that need no ROS.

# ROS 1's Python modules live with the system's Python. A pyenv or conda python first on PATH has none of them, and
# catkin then fails at configure time; so prefer the system's unless the user says otherwise.
if(WITH_ROS AND NOT DEFINED PYTHON_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that has the ROS modules")
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that has the ROS modules")
endif()

# Eigen 5 says that it is not compatible with 3.3, so the version is compared here.
find_package(Eigen3 REQUIRED)
if(Eigen3_VERSION VERSION_LESS 3.3)
  message(FATAL_ERROR "Eigen ${Eigen3_VERSION} is too old: 3.3 or newer is needed")
endif()
get_target_property(EIGEN3_INCLUDE_DIRS Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)  # which Eigen 5 does not set

find_package(yaml-cpp REQUIRED)
if(TARGET yaml-cpp::yaml-cpp)  # since yaml-cpp 0.8
  set(yaml_cpp yaml-cpp::yaml-cpp)
else()
  set(yaml_cpp yaml-cpp)
endif()

find_package(Boost REQUIRED COMPONENTS program_options)
find_package(Threads REQUIRED)

if(WITH_TOOLS)
  find_package(Ceres REQUIRED)
  # As plain libraries: the CMake files of TBB and NLopt differ between releases, or are missing.
  foreach(name tbb nlopt)
    find_library(LIVE_STIFFNESS_${name} ${name})
    if(NOT LIVE_STIFFNESS_${name})
      message(FATAL_ERROR "lib${name} not found: run scripts/install_dependencies, or install lib${name}-dev")
    endif()
  endforeach()
endif()
