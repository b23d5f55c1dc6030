#pragma once
// Measured compliances of a robot, as in Tables 5 and 6 of Shi et al.: chamber pressures and the 3x3 block of
// translation.

#include <string>
#include <vector>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

struct ComplianceRow {
  std::string name;  // such as "TABLE.csv line 3"
  Pressures pressures;  // gauge, Pa, one per chamber, base to tip
  Matrix3 compliance;   // small displacement of T per force on it, base axes, m/N
};

// Reads CSV with one header line, columns in any order: pressure_K_pa for K = 1 to the number of chambers, and
// c11_m_per_n to c33_m_per_n (cij: displacement along i per force along j). Throws ConfigurationError with every fault.
std::vector<ComplianceRow> loadComplianceTable(const std::string& path, int chamber_count);
std::vector<ComplianceRow> parseComplianceTable(const std::string& csv, const std::string& name, int chamber_count);

}  // namespace live_stiffness
