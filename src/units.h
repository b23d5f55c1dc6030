#pragma once
// SI values of the units that inputs may have.

#include <string>

namespace live_stiffness {

// Pa per unit for Pa, kPa, bar, mbar, psi; 0 for any other name.
inline double pascalsPerUnit(const std::string& unit) {
  if (unit == "Pa") return 1.0;
  if (unit == "kPa") return 1e3;
  if (unit == "bar") return 1e5;
  if (unit == "mbar") return 1e2;
  if (unit == "psi") return 6894.757293168361;
  return 0.0;
}

// m per unit for m, mm.
inline double metresPerUnit(const std::string& unit) { return unit == "mm" ? 1e-3 : 1.0; }

}  // namespace live_stiffness
