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
    addOption(options, kPressureUnit, pressure_unit_);
    addOption(options, kPressureReference, pressure_reference_);
    addOption(options, kBagPositionUnit, position_unit_);
  }

  // Adds a fault for every option with an illegal value.
  BagFormat format(FaultList& faults) const {
    faults.check(kPressureUnit, pressure_unit_);
    faults.check(kPressureReference, pressure_reference_);
    faults.check(kBagPositionUnit, position_unit_);
    BagFormat format = format_;
    format.pressures.unit = pascalsPerUnit(pressure_unit_);
    format.pressures.absolute = pressure_reference_ == "absolute";
    format.position_unit = position_unit_ == "mm" ? 1e-3 : 1.0;
    return format;
  }

 private:
  BagFormat format_;
  std::string pressure_unit_ = kPressureUnit.standard, pressure_reference_ = kPressureReference.standard,
              position_unit_ = kPositionUnit.standard;
};

}  // namespace live_stiffness
