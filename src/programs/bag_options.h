#pragma once
// Command line options that say where in a bag what is, and in which units.

#include <boost/program_options.hpp>
#include <string>

#include "live_stiffness/checks.h"
#include "bags/bag_format.h"

namespace live_stiffness {

class BagOptions {
 public:
  // format: what holds without options.
  explicit BagOptions(const BagFormat& format = {}) : format_(format) {}
  void addTo(boost::program_options::options_description& options);
  // Adds every option that is not understood to the faults.
  BagFormat format(FaultList& faults) const;

 private:
  BagFormat format_;
  std::string pressure_unit_ = "Pa", pressure_reference_ = "gauge", position_unit_ = "m";
};

}  // namespace live_stiffness
