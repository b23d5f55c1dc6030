#pragma once
// The CSV that the solve programs read, row by row: inputs of the robot and optionally a wrench.

#include <istream>
#include <string>
#include <vector>

#include "csv_table.h"
#include "live_stiffness/conventions.h"

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

// {"p_1_pa", ...} from "p_", "_pa".
std::vector<std::string> numberedColumns(const std::string& before, const std::string& after, int count);

}  // namespace live_stiffness
