#pragma once
// Recordings of either kind, as programs take them.

#include <boost/program_options.hpp>
#include <string>

#include "live_stiffness/estimation/recording.h"
#ifdef LIVE_STIFFNESS_WITH_BAGS
#include "bag_options.h"
#endif

namespace live_stiffness {

class RecordingReader {
 public:
  // Those that say what is where in a bag, where the program was built with ROS.
  void addOptionsTo(boost::program_options::options_description& options);
  // A CSV recording, or a bag (*.bag) where the program was built with ROS. Prints the recording's warnings on standard
  // error. Throws ConfigurationError when it cannot be read, or an option is not understood.
  Recording load(const std::string& path) const;

#ifdef LIVE_STIFFNESS_WITH_BAGS
 private:
  BagOptions bag_;
#endif
};

}  // namespace live_stiffness
