#pragma once
// The tables of the solve programs: the CSV that they read, the CSV that they write, and the loop over their rows.

#include <chrono>
#include <functional>
#include <istream>
#include <string>
#include <vector>

#include "csv_table.h"
#include "live_stiffness/compliance/stiffness_model.h"

namespace live_stiffness {

struct InputRow {
  long line = 0;                        // in the file, from 1
  Eigen::VectorXd values;               // one per input
  Wrench wrench = Wrench::Zero();       // base axes
  std::string fault;                    // why the row cannot be used; empty if it can
};

class InputTable {
 public:
  // Reads the header: `inputs` and, all or none, fx_n .. mz_nm, in any order. Throws ConfigurationError with every
  // fault of the header.
  InputTable(std::istream& input, const std::vector<std::string>& inputs);

  // The next row that is not blank; false at the end. A row with a fault is returned, with `fault` set.
  bool next(InputRow& row);

 private:
  CsvTable table_;
  std::vector<int> inputs_, wrench_;  // columns; wrench_ is empty when there is none
};

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
