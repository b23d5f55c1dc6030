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
  double azimuth_deg_ = 0.0, height_ = 0.0, sign_ = 1.0, crosstalk_x_ = 0.0, crosstalk_y_ = 0.0, delay_ = 0.0;
  std::vector<std::string> channels_;
};

}  // namespace live_stiffness
