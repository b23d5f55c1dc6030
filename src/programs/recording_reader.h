#pragma once
// Reads recordings for programs: CSV, and bags (*.bag) if the program was built with ROS.

#include <boost/program_options.hpp>
#include <filesystem>
#include <iostream>
#include <string>

#include "calibration/calibration.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/estimation/recording.h"
#ifdef LIVE_STIFFNESS_WITH_BAGS
#include "bag_options.h"
#include "bags/recorded_bag.h"
#endif

namespace live_stiffness {

class RecordingReader {
 public:
  // Options for bags.
  void addOptionsTo([[maybe_unused]] boost::program_options::options_description& options) {
#ifdef LIVE_STIFFNESS_WITH_BAGS
    bag_.addTo(options);
#endif
  }

  // Prints the recording's warnings on standard error. Throws ConfigurationError if it cannot be read, or an option has an
  // illegal value.
  Recording load(const std::string& path) const {
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

#ifdef LIVE_STIFFNESS_WITH_BAGS
 private:
  BagOptions bag_;
#endif
};

// all or quasi_static; adds a fault for any other name.
inline SampleChoice sampleChoice(const std::string& name, FaultList& faults) {
  if (name != "all" && name != "quasi_static") faults.add("samples '" + name + "': must be all or quasi_static");
  return name == "all" ? SampleChoice::kAll : SampleChoice::kQuasiStatic;
}

}  // namespace live_stiffness
