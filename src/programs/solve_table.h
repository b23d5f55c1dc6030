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
  // Says that there is a row of units; see CsvTable.
  const std::string& note() const { return table_.note(); }

 private:
  CsvTable table_;
  std::vector<int> inputs_, wrench_;  // columns; wrench_ is empty when there is none
};

// Adds the columns of a pose (m; quaternion) and of a 6x6 matrix (row by row), and their numbers.
void addPoseColumns(const std::string& before, std::vector<std::string>& names);
void addMatrixColumns(const std::string& before, std::vector<std::string>& names);
void append(const Pose& X, std::vector<double>& numbers);
void append(const Matrix6& matrix, std::vector<double>& numbers);
inline void append(const Vector3& p, std::vector<double>& numbers) { numbers.insert(numbers.end(), p.data(), p.data() + 3); }

struct ResultRow {
  SolveStatus status;
  std::string fault;  // the reason as text, unless ok
  int iterations = 0;
  double solve_us = 0.0;
  std::vector<double> numbers;  // pose of the point that compliances are about, tangent and material compliance, and one
                                // number for each of the further columns
};

// The row of a solution, without further columns, which took from `start` until now. X: its pose that the compliances are
// about.
template <class Model, class Solution>
ResultRow resultRow(const Model& model, const Solution& solution, const Pose& X, std::chrono::steady_clock::time_point start) {
  ResultRow row;
  row.solve_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  row.status = solution.status;
  if (!row.status.ok()) row.fault = model.describe(row.status);
  row.iterations = solution.iterations;
  append(X, row.numbers);
  append(solution.compliance, row.numbers);
  append(solution.material_compliance, row.numbers);
  return row;
}

// Reads and solves all rows. Writes the table to standard output, and faults with their line to standard error; there also
// the progress, if only that is a terminal. Rows that fail have empty columns. Returns the number of failed rows.
long solveTable(InputTable& table, const std::vector<std::string>& further_columns,
                const std::function<ResultRow(const InputRow&)>& solve);

}  // namespace live_stiffness
