#pragma once
// What no tracker and no pressure sensor of a soft arm measures: one set of rules for messages and for recordings.

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/estimation/recording.h"

namespace live_stiffness {

constexpr double kPlausibleReach = 5.0;  // m from tracker and base; positions farther away are in millimetres

// What a user does about data that mean something else than was said, such as "set ~pressure_reference: gauge".
struct Remedies {
  std::string millimetres, pressure_unit;
  std::string gauge, absolute;  // pressures are gauge, absolute
  std::string milliseconds;     // empty: times have no unit to choose
};

// Of what reads messages: the node, and programs that read bags, whose options are called like its parameters.
inline const Remedies kInputRemedies{"aurora_position_unit: mm", "pressure_unit", "pressure_reference: gauge",
                                     "pressure_reference: absolute", ""};

// Why a value cannot be used; empty: it can.
std::string poseFault(const Vector3& position, const Eigen::Quaterniond& orientation);  // m
// tracker_distance, base_distance: of the tip from both, m; the same one twice if the base is not known.
std::string reachFault(double tracker_distance, double base_distance, const Remedies& remedies);
// value: as it was sent, in any unit; gauge: what that is, Pa. To be put after the name of what was measured.
std::string pressureFault(double value, bool is_absolute, double gauge, const Remedies& remedies);

// What makes all samples of a recording implausible, though not each alone: units, and gauge for absolute pressures or the
// reverse. largest_pressure: that the scene can take, Pa (gauge); none: not known.
std::vector<std::string> unitWarnings(const Recording& recording, const Remedies& remedies,
                                      std::optional<double> largest_pressure = std::nullopt);

}  // namespace live_stiffness
