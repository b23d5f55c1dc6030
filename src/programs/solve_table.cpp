#include "solve_table.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <iostream>

namespace live_stiffness {
namespace {

using Clock = std::chrono::steady_clock;

// Of a row without further columns.
std::vector<std::string> resultColumns() {
  std::vector<std::string> names{"status", "iterations", "solve_us"};
  addPoseColumns("", names);
  for (const char* matrix : {"c_", "material_"}) addMatrixColumns(matrix, names);
  return names;
}

void printRow(const ResultRow& row, size_t columns) {
  std::string text = codeName(row.status.code);
  if (row.status.ok()) {
    std::printf("%s,%d,%.3f", text.c_str(), row.iterations, row.solve_us);
    for (double number : row.numbers) std::printf(",%.17g", number);
    std::putchar('\n');
  } else {
    std::puts(text.append(columns - 1, ',').c_str());
  }
}

}  // namespace

void addPoseColumns(const std::string& before, std::vector<std::string>& names) {
  for (const char* name : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"}) names.push_back(before + name);
}

void addMatrixColumns(const std::string& before, std::vector<std::string>& names) {
  for (int i = 1; i <= 6; ++i)
    for (int j = 1; j <= 6; ++j) names.push_back(before + std::to_string(i) + std::to_string(j));
}

void append(const Pose& X, std::vector<double>& numbers) {
  append(X.p, numbers);
  const Eigen::Quaterniond q(X.R);
  for (double value : {q.w(), q.x(), q.y(), q.z()}) numbers.push_back(value);
}

void append(const Matrix6& matrix, std::vector<double>& numbers) {
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) numbers.push_back(matrix(i, j));
}

InputTable::InputTable(std::istream& input, const std::vector<std::string>& inputs) : table_(input) {
  FaultList faults("header of the table on standard input");
  inputs_ = table_.requireAll(inputs, faults);
  const size_t before = faults.faults().size();
  wrench_ = table_.requireAllOrNone({"fx_n", "fy_n", "fz_n", "mx_nm", "my_nm", "mz_nm"}, faults);
  if (faults.faults().size() > before) faults.add("columns of the wrench: give all six or none");
  for (int column : table_.unknown())
    faults.add("column " + table_.names()[column] + ": unknown; known are " + inputs.front() + " to " + inputs.back() +
               " and fx_n, fy_n, fz_n, mx_nm, my_nm, mz_nm");
  faults.throwIfAny();
}

bool InputTable::next(InputRow& row) {
  row = InputRow();
  if (!table_.next(row.fault)) return false;
  row.line = table_.line();
  row.values.setZero(static_cast<long>(inputs_.size()));
  if (!row.fault.empty()) return true;
  row.values = table_.numbers(inputs_, row.fault);
  if (!wrench_.empty()) row.wrench = table_.numbers(wrench_, row.fault);
  return true;
}

long solveTable(InputTable& table, const std::vector<std::string>& further_columns,
                const std::function<ResultRow(const InputRow&)>& solve) {
  const bool shows_progress = isatty(STDERR_FILENO) && !isatty(STDOUT_FILENO);
  auto last_progress = Clock::now();
  long rows = 0, failed = 0;
  std::vector<std::string> columns = resultColumns();
  columns.insert(columns.end(), further_columns.begin(), further_columns.end());
  for (size_t k = 0; k < columns.size(); ++k) std::printf("%s%c", columns[k].c_str(), k + 1 < columns.size() ? ',' : '\n');
  if (!table.note().empty()) std::cerr << table.note() << '\n';
  InputRow input;
  while (table.next(input)) {
    ResultRow row;
    if (input.fault.empty()) {
      row = solve(input);
    } else {
      row.status.code = SolveCode::kInvalidInput;
      row.fault = input.fault;
    }
    printRow(row, columns.size());
    ++rows;
    if (!row.fault.empty()) {
      ++failed;
      std::cerr << "line " << input.line << ": " << row.fault << '\n';
    }
    if (std::cin.rdbuf()->in_avail() <= 0) std::fflush(stdout);
    if (shows_progress && Clock::now() - last_progress > std::chrono::seconds(1)) {
      last_progress = Clock::now();
      std::cerr << rows << " rows solved, " << failed << " failed\r" << std::flush;
    }
  }
  return failed;
}

}  // namespace live_stiffness
