#pragma once
// Reads recordings for programs, CSV or bags.

#include <boost/program_options.hpp>
#include <string>

#include "calibration/calibration.h"
#include "live_stiffness/checks.h"
#include "live_stiffness/estimation/recording.h"
#ifdef LIVE_STIFFNESS_WITH_BAGS
#include "bag_options.h"
#endif

namespace live_stiffness {

class RecordingReader {
 public:
  // Options for bags, if the program was built with ROS.
  void addOptionsTo(boost::program_options::options_description& options);
  // A CSV recording, or a bag (*.bag) if the program was built with ROS. Prints the recording's warnings on standard
  // error. Throws ConfigurationError if it cannot be read, or an option has an illegal value.
  Recording load(const std::string& path) const;

#ifdef LIVE_STIFFNESS_WITH_BAGS
 private:
  BagOptions bag_;
#endif
};

// all or quasi_static; adds a fault for any other name.
SampleChoice sampleChoice(const std::string& name, FaultList& faults);

}  // namespace live_stiffness
