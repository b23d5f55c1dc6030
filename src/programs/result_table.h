#pragma once
// The CSV that the solve programs write, and the loop over their rows.

#include <chrono>
#include <functional>
#include <vector>

#include "input_table.h"
#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

struct ResultRow {
  SolveStatus status;
  std::string fault;  // the reason as text, unless ok
  int iterations = 0;
  double solve_us = 0.0;
  Pose X;  // of the point that compliances are about
  Matrix6 compliance = Matrix6::Zero(), material_compliance = Matrix6::Zero();
  std::vector<double> more;  // one number for each of the further columns
};

// The row of a solution, which took from `start` until now. X: its pose that the compliances are about.
template <class Model, class Solution>
ResultRow resultRow(const Model& model, const Solution& solution, const Pose& X, std::chrono::steady_clock::time_point start) {
  ResultRow row;
  row.solve_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  row.status = solution.status;
  if (!row.status.ok()) row.fault = model.describe(row.status);
  row.iterations = solution.iterations;
  row.X = X;
  row.compliance = solution.compliance;
  row.material_compliance = solution.material_compliance;
  return row;
}

// Reads and solves all rows. Writes the table to standard output, and faults with their line to standard error; there also
// the progress, if only that is a terminal. Rows that fail have empty columns. Returns the number of failed rows.
long solveTable(InputTable& table, const std::vector<std::string>& further_columns,
                const std::function<ResultRow(const InputRow&)>& solve);

}  // namespace live_stiffness
