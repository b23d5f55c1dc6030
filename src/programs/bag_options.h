#pragma once
// Command line options for the topics and units of a bag.

#include <boost/program_options.hpp>
#include <string>

#include "live_stiffness/parameters.h"
#include "bags/bag_reader.h"

namespace live_stiffness {

class BagOptions {
 public:
  // format: the defaults.
  explicit BagOptions(const BagFormat& format = {}) : format_(format) {}
  void addTo(boost::program_options::options_description& options);
  // Adds a fault for every option with an illegal value.
  BagFormat format(FaultList& faults) const;

 private:
  BagFormat format_;
  std::string pressure_unit_ = kPressureUnit.standard, pressure_reference_ = kPressureReference.standard,
              position_unit_ = kPositionUnit.standard;
};

}  // namespace live_stiffness
