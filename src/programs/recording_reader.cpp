#include "recording_reader.h"

#include <filesystem>
#include <iostream>

#include "live_stiffness/checks.h"
#ifdef LIVE_STIFFNESS_WITH_BAGS
#include "bags/recorded_bag.h"
#endif

namespace live_stiffness {
namespace {

bool isBag(const std::string& path) { return std::filesystem::path(path).extension() == ".bag"; }

Recording withWarningsPrinted(Recording recording, const std::string& path) {
  for (const std::string& warning : recording.warnings) std::cerr << path << ": " << warning << '\n';
  return recording;
}

}  // namespace

#ifdef LIVE_STIFFNESS_WITH_BAGS

void RecordingReader::addOptionsTo(boost::program_options::options_description& options) { bag_.addTo(options); }

Recording RecordingReader::load(const std::string& path) const {
  FaultList faults("options");
  const BagFormat format = bag_.format(faults);
  faults.throwIfAny();
  return withWarningsPrinted(isBag(path) ? loadRecordedBag(path, format) : loadRecording(path), path);
}

#else

void RecordingReader::addOptionsTo(boost::program_options::options_description&) {}

Recording RecordingReader::load(const std::string& path) const {
  if (isBag(path))
    throw ConfigurationError("recording " + path, {"this build reads no bags: build it with ROS (-DWITH_ROS=ON)"});
  return withWarningsPrinted(loadRecording(path), path);
}

#endif

}  // namespace live_stiffness
