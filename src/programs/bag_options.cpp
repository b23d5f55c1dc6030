#include "bag_options.h"

namespace po = boost::program_options;

namespace live_stiffness {

void BagOptions::addTo(po::options_description& options) {
  options.add_options()
    ("pressures", po::value(&format_.pressure_topic)->default_value(format_.pressure_topic), "topic of the pressures in a bag")
    ("pose", po::value(&format_.pose_topic)->default_value(format_.pose_topic), "topic of the tracker")
    ("tip-wrench", po::value(&format_.wrench_topic)->default_value(format_.wrench_topic), "topic of the tip wrench")
    ("pressure-unit", po::value(&pressure_unit_)->default_value(pressure_unit_), "Pa, kPa, bar, mbar or psi")
    ("pressure-reference", po::value(&pressure_reference_)->default_value(pressure_reference_), "gauge or absolute")
    ("position-unit", po::value(&position_unit_)->default_value(position_unit_), "m or mm");
}

BagFormat BagOptions::format(FaultList& faults) const {
  BagFormat format = format_;
  format.pressures.unit = pascalsPerUnit(pressure_unit_);
  if (!(format.pressures.unit > 0.0))
    faults.add("pressure-unit: " + pressure_unit_ + " is not known: must be Pa, kPa, bar, mbar or psi");
  format.pressures.absolute = pressure_reference_ == "absolute";
  if (pressure_reference_ != "gauge" && pressure_reference_ != "absolute")
    faults.add("pressure-reference: " + pressure_reference_ + " is not known: must be gauge or absolute");
  format.position_unit = position_unit_ == "mm" ? 1e-3 : 1.0;
  if (position_unit_ != "m" && position_unit_ != "mm")
    faults.add("position-unit: " + position_unit_ + " is not known: must be m or mm");
  return format;
}

}  // namespace live_stiffness
