#include "bag_options.h"

#include "parameter_options.h"

namespace po = boost::program_options;

namespace live_stiffness {
namespace {

// A bag's tracker need not be an Aurora.
const ChoiceParameter kBagPositionUnit{"position_unit", kPositionUnit.standard, kPositionUnit.choices, kPositionUnit.meaning};

}  // namespace

void BagOptions::addTo(po::options_description& options) {
  options.add_options()
    ("pressures", po::value(&format_.pressure_topic)->default_value(format_.pressure_topic), "topic of the pressures in a bag")
    ("pose", po::value(&format_.pose_topic)->default_value(format_.pose_topic), "topic of the tracker")
    ("tip-wrench", po::value(&format_.wrench_topic)->default_value(format_.wrench_topic), "topic of the tip wrench");
  addOption(options, kPressureUnit, pressure_unit_);
  addOption(options, kPressureReference, pressure_reference_);
  addOption(options, kBagPositionUnit, position_unit_);
}

BagFormat BagOptions::format(FaultList& faults) const {
  faults.check(kPressureUnit, pressure_unit_);
  faults.check(kPressureReference, pressure_reference_);
  faults.check(kBagPositionUnit, position_unit_);
  BagFormat format = format_;
  format.pressures.unit = pascalsPerUnit(pressure_unit_);
  format.pressures.absolute = pressure_reference_ == "absolute";
  format.position_unit = position_unit_ == "mm" ? 1e-3 : 1.0;
  return format;
}

}  // namespace live_stiffness
