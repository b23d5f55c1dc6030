# The ROS packages that are used, our messages, and what other packages find here.

set(ros_packages
  diagnostic_msgs
  diagnostic_updater
  dynamic_reconfigure
  geometry_msgs
  interactive_markers
  nav_msgs
  nodelet
  pluginlib
  roscpp
  roslib
  sensor_msgs
  std_msgs
  std_srvs
  tf2_ros
  topic_tools
  visualization_msgs
)
find_package(catkin REQUIRED COMPONENTS message_generation ${ros_packages})
if(WITH_BAGS)
  find_package(rosbag REQUIRED)
endif()

add_message_files(FILES
  ChamberPressures.msg
  PlatformEstimate.msg
  RodLengths.msg
  StiffnessEstimate.msg
  TipContact.msg
  TrackingError.msg
)
add_service_files(FILES
  ComplianceAt.srv
  DirectionalStiffness.srv
  PredictDeflection.srv
  Register.srv
)
generate_messages(DEPENDENCIES geometry_msgs std_msgs)
generate_dynamic_reconfigure_options(cfg/Stiffness.cfg)
# It reads the header that defines the parameters.
add_custom_command(OUTPUT ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_INCLUDE_DESTINATION}/StiffnessConfig.h APPEND
  DEPENDS include/live_stiffness/parameters.h scripts/parameter_specs.py)

set(libraries live_stiffness_core live_stiffness_parallel live_stiffness_ros)
if(WITH_TOOLS)
  list(APPEND libraries live_stiffness_calibration)
endif()
catkin_package(
  INCLUDE_DIRS include
  LIBRARIES ${libraries}
  CATKIN_DEPENDS message_runtime ${ros_packages}
  DEPENDS EIGEN3
)
