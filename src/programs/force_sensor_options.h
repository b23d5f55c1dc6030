#pragma once
// Command line options for the mount of a recording's force sensor on the tip.

#include <boost/program_options.hpp>
#include <string>
#include <vector>

#include "calibration/force_sensor.h"

namespace live_stiffness {

class ForceSensorOptions {
 public:
  void addTo(boost::program_options::options_description& options);
  // Throws ConfigurationError with every value that is out of range.
  ForceSensorMount mount() const;
  // A mount as such options, for example the result of a calibration.
  static std::string text(const ForceSensorMount& mount);

 private:
  ForceSensorMount mount_;
  std::vector<std::string> channels_;
};

}  // namespace live_stiffness
