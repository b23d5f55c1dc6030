#pragma once
// The output of stiffness_map, a CSV.

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "analysis/stiffness_sweep.h"
#include "part_file.h"

namespace live_stiffness {

// p_1_pa ... p_N_pa (of the chambers), status, x_m .. qz, eta_1_n .. eta_6_n, tau_n or tau_n_per_m. A failed row keeps
// its columns, empty.
class MapTable {
 public:
  // Starts the file; path -: standard output. Throws ConfigurationError if it cannot be written.
  MapTable(const std::string& path, const PressurePlan& plan, const StiffnessCriterion& criterion);
  ~MapTable();

  // Rows from `first` on; texts are made on all cores.
  void write(long first, const std::vector<SweepRow>& rows);
  // Gives the file its name; without it none is left. Throws ConfigurationError if the disk did not take all.
  void close();

 private:
  // Lines of the rows from begin to end, of which row 0 is number `first` of the plan.
  std::string textOf(long first, const std::vector<SweepRow>& rows, size_t begin, size_t end) const;

  const PressurePlan& plan_;
  std::unique_ptr<PartFile> part_;  // none: standard output
  std::FILE* file_ = stdout;
};

}  // namespace live_stiffness
