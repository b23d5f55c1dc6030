#pragma once
// A CSV file, written row by row.

#include <fstream>
#include <stdexcept>
#include <string>

namespace live_stiffness {

class CsvFile {
 public:
  // columns: names, separated by commas.
  CsvFile(const std::string& folder, const std::string& name, const std::string& columns)
      : file_(folder + "/" + name) {
    if (!file_) throw std::runtime_error(folder + "/" + name + ": cannot be written");
    file_.precision(9);
    file_ << columns << "\n";
  }

  // Values must not hold commas.
  template <class First, class... Others>
  void row(const First& first, const Others&... others) {
    file_ << first;
    ((file_ << ',' << others), ...);
    file_ << std::endl;
  }

 private:
  std::ofstream file_;
};

}  // namespace live_stiffness
