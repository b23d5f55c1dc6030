#pragma once
// The CSV that the solve programs write, and the loop over their rows.

#include <functional>
#include <vector>

#include "input_table.h"
#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

struct ResultRow {
  SolveStatus status;
  std::string fault;  // in words, unless ok
  int iterations = 0;
  double solve_us = 0.0;
  Pose X;  // of the point that compliances are about
  Matrix6 compliance = Matrix6::Zero(), material_compliance = Matrix6::Zero();
  std::vector<double> more;  // one for each of the further columns
};

// Reads and solves all rows; writes the table to standard output, faults with their line to standard error, and there
// also the progress if only a person sees it. Rows that fail keep their columns, empty. Returns how many failed.
long solveTable(InputTable& table, const std::vector<std::string>& further_columns,
                const std::function<ResultRow(const InputRow&)>& solve);

}  // namespace live_stiffness
