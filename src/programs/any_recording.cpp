#include "any_recording.h"

#include <filesystem>
#include <iostream>

#include "live_stiffness/checks.h"
#ifdef LIVE_STIFFNESS_WITH_ROS
#include "live_stiffness/ros/recorded_bag.h"
#endif

namespace live_stiffness {
namespace {

Recording load(const std::string& path) {
  if (std::filesystem::path(path).extension() != ".bag") return loadRecording(path);
#ifdef LIVE_STIFFNESS_WITH_ROS
  return loadRecordedBag(path);
#else
  throw ConfigurationError("recording " + path, {"this build reads no bags: build it with ROS (-DWITH_ROS=ON)"});
#endif
}

}  // namespace

Recording loadAnyRecording(const std::string& path) {
  Recording recording = load(path);
  for (const std::string& warning : recording.warnings) std::cerr << path << ": " << warning << '\n';
  return recording;
}

}  // namespace live_stiffness
