#pragma once
// Tables of numbers as CSV: a header line with the names of the columns, then a line a row, as programs and spreadsheets write
// them. The separator is a comma, semicolon or tab, whichever the header has most of, or that of a first line `sep=;`. Fields
// may stand in quotes. Numbers have a decimal point whatever the locale of the process; if the separator is no comma, all may
// have a decimal comma instead. Names are in lower case. What means nothing: blanks around fields, blank lines, separators at
// the end of a line, comments (# or %) before the header, a row of units below it. If no header follows, the last comment is it.

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "live_stiffness/checks.h"
#include "live_stiffness/conventions.h"
#include "text_lines.h"

namespace live_stiffness {

class CsvTable {
 public:
  // Reads the header and the line below it. `input` has to outlive the table.
  explicit CsvTable(std::istream& input);

  const std::vector<std::string>& names() const { return names_; }
  // Index of the column; none if there is no such column.
  std::optional<int> find(const std::string& name);
  // The same, and 0 with a fault if there is none; a fault, too, if there are two, or the row of units contradicts the name.
  int require(const std::string& name, FaultList& faults);
  // The same of several columns.
  std::vector<int> requireAll(const std::vector<std::string>& names, FaultList& faults);
  // The same of columns that are given all together or not at all; empty: not at all.
  std::vector<int> requireAllOrNone(const std::vector<std::string>& names, FaultList& faults);
  // Indices of the columns with a name that nobody has asked for.
  std::vector<int> unknown() const;
  // Says that there is a row of units, which is no row of the table; empty: there is none.
  const std::string& note() const { return note_; }

  // Reads the next row; false at the end. fault: empty, or that it has more or fewer fields than the header, or an open quote.
  bool next(std::string& fault);
  // Number of the present row's line, from 1.
  long line() const { return lines_.number(); }
  // Of the present row, which has as many fields as the header. Zero if the field is no finite number; then `fault` says so
  // with column and text, unless it says something already.
  double number(int column, std::string& fault);
  // The same of several columns.
  Eigen::VectorXd numbers(const std::vector<int>& columns, std::string& fault);

 private:
  bool readRow();   // false at the end
  bool splitRow();  // false: it is blank
  std::optional<double> parsed(const std::string& field);

  TextLines lines_;
  char separator_ = 0;  // 0: not known yet
  char decimal_mark_ = 0;
  std::vector<std::string> names_, units_, fields_;
  std::vector<bool> asked_;
  std::string text_, row_fault_, note_;
  bool has_first_row_ = false;  // in fields_, read already
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
