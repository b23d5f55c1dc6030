#pragma once
// Command line options for the topics and units of a bag.

#include <boost/program_options.hpp>
#include <string>

#include "bags/bag_reader.h"
#include "live_stiffness/parameters.h"
#include "parameter_options.h"

namespace live_stiffness {

// A bag's tracker need not be an Aurora.
inline const ChoiceParameter kBagPositionUnit{"position_unit", kPositionUnit.standard, kPositionUnit.choices,
                                              kPositionUnit.meaning};

class BagOptions {
 public:
  // format: the defaults.
  explicit BagOptions(const BagFormat& format = {}) : format_(format) {}

  void addTo(boost::program_options::options_description& options) {
    using boost::program_options::value;
    options.add_options()
      ("pressures", value(&format_.pressure_topic)->default_value(format_.pressure_topic), "topic of the pressures in a bag")
      ("pose", value(&format_.pose_topic)->default_value(format_.pose_topic), "topic of the tracker")
      ("tip-wrench", value(&format_.wrench_topic)->default_value(format_.wrench_topic), "topic of the tip wrench");
    addOption(options, kPressureUnit, format_.pressures.unit);
    addOption(options, kPressureReference, format_.pressures.reference);
    addOption(options, kBagPositionUnit, format_.position_unit);
  }

  // Adds a fault for every option with an illegal value.
  const BagFormat& format(FaultList& faults) const {
    faults.checkAll(format_.pressures);
    faults.check(kBagPositionUnit, format_.position_unit);
    return format_;
  }

 private:
  BagFormat format_;
};

}  // namespace live_stiffness
