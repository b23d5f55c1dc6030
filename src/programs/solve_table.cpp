#include "solve_table.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <iostream>

namespace live_stiffness {
namespace {

using Clock = std::chrono::steady_clock;

void printHeader(const std::vector<std::string>& further_columns) {
  std::string header = "status,iterations,solve_us,x_m,y_m,z_m,qw,qx,qy,qz";
  for (const char* matrix : {"c_", "material_"})
    for (int i = 1; i <= 6; ++i)
      for (int j = 1; j <= 6; ++j) header += "," + (matrix + std::to_string(i)) + std::to_string(j);
  for (const std::string& name : further_columns) header += "," + name;
  std::puts(header.c_str());
}

void printNumber(double value) { std::printf(",%.17g", value); }

void printRow(const ResultRow& row, size_t further_columns) {
  std::fputs(codeName(row.status.code), stdout);
  if (!row.status.ok()) {
    for (size_t column = 0; column < 9 + 72 + further_columns; ++column) std::putchar(',');
  } else {
    std::printf(",%d,%.3f", row.iterations, row.solve_us);
    for (int i = 0; i < 3; ++i) printNumber(row.X.p[i]);
    const Eigen::Quaterniond q(row.X.R);
    for (double value : {q.w(), q.x(), q.y(), q.z()}) printNumber(value);
    for (const Matrix6* matrix : {&row.compliance, &row.material_compliance})
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) printNumber((*matrix)(i, j));
    for (double value : row.more) printNumber(value);
  }
  std::putchar('\n');
}

}  // namespace

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
  printHeader(further_columns);
  InputRow input;
  while (table.next(input)) {
    ResultRow row;
    if (input.fault.empty()) {
      row = solve(input);
    } else {
      row.status.code = SolveCode::kInvalidInput;
      row.fault = input.fault;
    }
    printRow(row, further_columns.size());
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
