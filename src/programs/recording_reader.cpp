#include "recording_reader.h"

#include <filesystem>
#include <iostream>

#ifdef LIVE_STIFFNESS_WITH_BAGS
#include "bags/recorded_bag.h"
#endif

namespace live_stiffness {

void RecordingReader::addOptionsTo([[maybe_unused]] boost::program_options::options_description& options) {
#ifdef LIVE_STIFFNESS_WITH_BAGS
  bag_.addTo(options);
#endif
}

Recording RecordingReader::load(const std::string& path) const {
  const bool is_bag = std::filesystem::path(path).extension() == ".bag";
#ifdef LIVE_STIFFNESS_WITH_BAGS
  FaultList faults("options");
  const BagFormat format = bag_.format(faults);
  faults.throwIfAny();
  Recording recording = is_bag ? loadRecordedBag(path, format) : loadRecording(path);
#else
  if (is_bag) throw ConfigurationError("recording " + path, {"this build reads no bags: build it with ROS (-DWITH_ROS=ON)"});
  Recording recording = loadRecording(path);
#endif
  for (const std::string& warning : recording.warnings) std::cerr << path << ": " << warning << '\n';
  return recording;
}

SampleChoice sampleChoice(const std::string& name, FaultList& faults) {
  if (name != "all" && name != "quasi_static") faults.add("samples '" + name + "': must be all or quasi_static");
  return name == "all" ? SampleChoice::kAll : SampleChoice::kQuasiStatic;
}

}  // namespace live_stiffness
