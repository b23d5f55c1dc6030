#pragma once
// The CSV that stiffness_solve reads: pressures and optionally a tip wrench, a row at a time.

#include <istream>
#include <string>
#include <vector>

#include "live_stiffness/conventions.h"

namespace live_stiffness {

struct PressureRow {
  long line = 0;                        // in the file, from 1
  Pressures pressures;                  // gauge, Pa, one per chamber
  Wrench tip_wrench = Wrench::Zero();   // base axes
  std::string fault;                    // why the row cannot be used; empty if it can
};

class PressureTable {
 public:
  // Reads the header: p_1_pa .. p_N_pa and, all or none, fx_n .. mz_nm, in any order. Throws ConfigurationError with
  // every fault of the header.
  PressureTable(std::istream& input, int chambers);

  // The next row that is not blank; false at the end. A row with a fault is returned, with `fault` set.
  bool next(PressureRow& row);

 private:
  std::istream& input_;
  int chambers_;
  std::vector<int> slots_;  // per column: pressure index, or chambers + index in the wrench
  std::vector<std::string> names_;
  long line_ = 0;
};

}  // namespace live_stiffness
