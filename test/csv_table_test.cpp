#include "csv_table.h"

#include <gtest/gtest.h>

#include <sstream>

#include "support/decimal_comma.h"

namespace live_stiffness {
namespace {

// What all rows of a table give.
struct Read {
  std::vector<double> numbers;
  std::vector<std::string> faults;
};
Read readAll(CsvTable& table, int column) {
  Read read;
  for (std::string fault; table.next(fault);) {
    const double number = fault.empty() ? table.number(column, fault) : 0.0;
    if (fault.empty()) read.numbers.push_back(number);
    else read.faults.push_back("line " + std::to_string(table.line()) + ": " + fault);
  }
  return read;
}

TEST(CsvTable, FindsNumbersByTheNameOfTheirColumn) {
  std::istringstream text("\xEF\xBB\xBF" "a, b ,c\r\n1, -2.5e-3 ,3\r\n\n4,5,6");
  CsvTable table(text);
  FaultList faults("table");
  const int column = table.require("b", faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(readAll(table, column).numbers, std::vector<double>({-2.5e-3, 5.0}));
}

TEST(CsvTable, NamesLineColumnAndValueOfWhatItCannotRead) {
  std::istringstream text("a,b\n1,2\n1\n\n1,two\n1,inf\n1,\n1,2 3\n");
  CsvTable table(text);
  EXPECT_EQ(readAll(table, *table.find("b")).faults,
            std::vector<std::string>({"line 3: 1 fields: must be 2, as in the header",
                                      "line 5: b = 'two': must be a finite number",
                                      "line 6: b = 'inf': must be a finite number",
                                      "line 7: b = '': must be a finite number",
                                      "line 8: b = '2 3': must be a finite number"}));
}

TEST(CsvTable, SaysWhichColumnsAreMissingRepeatedAndUnknown) {
  std::istringstream text("a,b,a,,d\n");
  CsvTable table(text);
  FaultList faults("table");
  table.require("a", faults);
  table.require("e", faults);
  EXPECT_EQ(faults.faults(), std::vector<std::string>({"column a is given more than once", "column e is missing"}));
  EXPECT_EQ(table.unknown(), std::vector<int>({1, 4}));
}

TEST(CsvTable, OfNothingHasNoColumnAndNoRow) {
  std::istringstream text("\n \n");
  CsvTable table(text);
  std::string fault;
  EXPECT_FALSE(table.find("a"));
  EXPECT_FALSE(table.next(fault));
}

TEST(NumberList, IsAllNumbersOrNone) {
  EXPECT_EQ(numberList("0.5, 1,-2", ','), std::vector<double>({0.5, 1.0, -2.0}));
  for (const char* text : {"", "1,", "1,,2", "1:2", "1,nan", "1 2"}) EXPECT_FALSE(numberList(text, ',')) << text;
}

// In a German locale strtod() takes a comma, and stops at the point.
TEST(FiniteNumber, HasAPointWhateverTheLocaleOfTheProcess) {
  const GermanC german(std::string(::testing::TempDir()) + "csv_table_locale");
  if (!german.isSet()) GTEST_SKIP() << "no localedef, or none of its sources (package locales)";
  EXPECT_EQ(finiteNumber("1.5"), 1.5);
  EXPECT_FALSE(finiteNumber("1,5"));
}

TEST(FiniteNumber, SaysHowToWriteWhatItDoesNotTake) {
  const std::pair<const char*, const char*> hints[] = {
      {"1,5", "; write 1.5"}, {"0,060", "; write 0.060"}, {"-1,5e3", "; write -1.5e3"},
      {"120,000", "; write 120.000 or 120000"}, {"1,234.5", "; write 1234.5"}, {"1.234,5", "; write 1234.5"},
      {"1,234,567", "; write 1234567"}, {"1_000", "; write 1000"}, {"12 000", "; write 12000"},
      {"\xE2\x88\x92" "9.81", "; write -9.81"},
      {"12e3Pa", "; write the number alone, 12e3, in the unit that the key ends in"},
      {"40 mm", "; write the number alone, 40, in the unit that the key ends in"},
      {"3.5 \xC2\xB5m", "; write the number alone, 3.5, in the unit that the key ends in"},
      {"wide", ""}, {"", ""}, {"1/3", ""}, {".nan", ""}, {"inf", ""}, {",", ""}, {"1,2,3.4", ""}};
  for (const auto& [text, hint] : hints) EXPECT_EQ(numberHint(text), hint) << text;
}

}  // namespace
}  // namespace live_stiffness
