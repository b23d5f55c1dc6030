#pragma once
// The output of stiffness_map: a CSV, and optionally the same as a NumPy array.

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
  // Starts the files; npy_path empty: no array. Throws ConfigurationError if one cannot be written.
  MapTable(const std::string& csv_path, const std::string& npy_path, const PressurePlan& plan,
           const StiffnessCriterion& criterion);
  ~MapTable();
  MapTable(const MapTable&) = delete;
  MapTable& operator=(const MapTable&) = delete;

  // Rows from `first` on; texts are made on all cores.
  void write(long first, const std::vector<SweepRow>& rows);
  // Gives the files their names; without it none is left. Throws ConfigurationError if the disk did not take all.
  void close();

 private:
  // Lines of the rows from begin to end, of which row 0 is number `first` of the plan.
  std::string textOf(long first, const std::vector<SweepRow>& rows, size_t begin, size_t end) const;
  void writeArray(long first, const std::vector<SweepRow>& rows);

  const PressurePlan& plan_;
  std::unique_ptr<PartFile> csv_part_, npy_part_;  // none: standard output, or not asked for
  std::FILE* csv_ = nullptr;
  std::FILE* npy_ = nullptr;
};

}  // namespace live_stiffness
