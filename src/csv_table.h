#pragma once
// Tables of numbers as CSV: a header line with the names of the columns, then a line a row. Numbers have a decimal point
// whatever the locale of the process; blanks around fields, blank lines and a byte order mark mean nothing.

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/checks.h"
#include "live_stiffness/conventions.h"

namespace live_stiffness {

class CsvTable {
 public:
  // Reads the header, the first line that is not blank. `input` has to outlive the table.
  explicit CsvTable(std::istream& input);

  const std::vector<std::string>& names() const { return names_; }
  // Index of the column; none if there is no such column.
  std::optional<int> find(const std::string& name);
  // The same, and 0 with a fault if there is none; a fault, too, if there are two.
  int require(const std::string& name, FaultList& faults);
  // The same of several columns.
  std::vector<int> requireAll(const std::vector<std::string>& names, FaultList& faults);
  // The same of columns that are given all together or not at all; empty: not at all.
  std::vector<int> requireAllOrNone(const std::vector<std::string>& names, FaultList& faults);
  // Indices of the columns with a name that nobody has asked for.
  std::vector<int> unknown() const;

  // Reads the next row; false at the end. fault: empty, or that it has more or fewer fields than the header.
  bool next(std::string& fault);
  // Number of the newest line, from 1.
  long line() const { return line_; }
  // Of the present row, which has as many fields as the header. Zero if the field is no finite number; then `fault` says so
  // with column and text, unless it says something already.
  double number(int column, std::string& fault) const;
  // The same of several columns.
  Eigen::VectorXd numbers(const std::vector<int>& columns, std::string& fault) const;

 private:
  bool readFields(std::vector<std::string>& fields);

  std::istream& input_;
  std::vector<std::string> names_, fields_;
  std::vector<bool> asked_;
  long line_ = 0;
};

// {"p_1_pa", "p_2_pa", ...} from "p_", "_pa".
std::vector<std::string> numberedColumns(const std::string& before, const std::string& after, int count);

// Parts of a text without the blanks around them; a text without separator is one part.
std::vector<std::string> splitText(const std::string& text, char separator);

// A finite number that fills the whole text.
std::optional<double> finiteNumber(const std::string& text);

// How to write what finiteNumber() does not take, as the end of a message: "; write 1.5" for 1,5. Empty if there is no guess.
std::string numberHint(const std::string& text);

// The numbers between separators; none unless all parts of the text are finite numbers.
std::optional<std::vector<double>> numberList(const std::string& text, char separator);

}  // namespace live_stiffness
