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

// As UTF-16 with a byte order mark.
std::string utf16(const std::string& text, bool big_endian) {
  std::string bytes = big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (char c : text) bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

TEST(CsvTable, IsTheSameInTheFormsThatProgramsWrite) {
  for (const std::string& form : {
           std::string("\xEF\xBB\xBF" "a,b,c\n1,-2.5,3\n4,5,6\n"),
           std::string("a,b,c\r1,-2.5,3\r4,5,6"),
           std::string("a,b,c\r\n1,-2.5,3\r\n\r\n4,5,6\r\n"),
           std::string("a;b;c\n1;-2.5;3\n4;5;6\n"),
           std::string("a;b;c\n1,0;-2,5;3\n4,0;5;6,00\n"),
           std::string("a\tb\tc\n1\t-2,5\t3\n4\t5\t6\n"),
           std::string("\"a\",\"b\",\"c\"\n\"1\",\" -2.5 \",3\n4,\"5\",6\n"),
           std::string("A,B,C\n1,-2.5,3\n4,5,6\n"),
           std::string("a,b,c,\n1,-2.5,3,\n4,5,6,\n"),
           std::string("a,b,c\n1,-2.5,3,,\n,,,,\n4,5,6\n"),
           std::string("sep=;\na;b;c\n1;-2.5;3\n4;5;6\n"),
           std::string("# by hand\n\n% on Monday\na,b,c\n1,-2.5,3\n4,5,6\n"),
           std::string("# first\n# a,b,c\n1,-2.5,3\n4,5,6\n"),  // numpy.savetxt
           utf16("a,b,c\r\n1,-2.5,3\r\n4,5,6\r\n", false),
           utf16("a;b;c\n1;-2,5;3\n4;5;6\n", true),
       }) {
    SCOPED_TRACE(form);
    std::istringstream text(form);
    CsvTable table(text);
    EXPECT_EQ(table.names(), std::vector<std::string>({"a", "b", "c"}));
    ASSERT_TRUE(table.find("b"));
    const Read read = readAll(table, *table.find("b"));
    EXPECT_EQ(read.numbers, std::vector<double>({-2.5, 5.0}));
    EXPECT_TRUE(read.faults.empty());
    EXPECT_EQ(table.note(), "");
  }
}

TEST(CsvTable, SeparatorsInQuotesSeparateNothing) {
  std::istringstream text("a,\"b, \"\"c\"\"\",d\n1,\"x,y\",3\n1,\"x,3\n1,,4\n");
  CsvTable table(text);
  EXPECT_EQ(table.names()[1], "b, \"c\"");
  const Read read = readAll(table, *table.find("d"));
  EXPECT_EQ(read.numbers, std::vector<double>({3.0, 4.0}));
  ASSERT_EQ(read.faults.size(), 1u);
  EXPECT_EQ(read.faults[0].find("line 3: a quote is open"), 0u) << read.faults[0];
}

// Read as a decimal mark, the comma of 101,325 would make 101.325 of it.
TEST(CsvTable, HasOneDecimalMark) {
  std::istringstream text("a\tb\n0.05\t101,325\n0.1\t1,013.25\n0.15\t7\n");
  CsvTable table(text);
  std::string fault;
  ASSERT_TRUE(table.next(fault));
  EXPECT_EQ(table.number(0, fault), 0.05);
  EXPECT_EQ(fault, "");
  table.number(1, fault);
  EXPECT_EQ(fault, "b = '101,325': must be a finite number");
  EXPECT_EQ(readAll(table, 1).numbers, std::vector<double>({7.0}));
}

TEST(CsvTable, LeavesOutARowOfUnitsAndSaysSo) {
  std::istringstream text("time_s,p_1_pa,p_2_kpa,q\n[s],[kPa],kPa,\n0,1,2,3\n");
  CsvTable table(text);
  EXPECT_NE(table.note().find("line 2"), std::string::npos) << table.note();
  FaultList faults("table");
  table.requireAll({"time_s", "p_2_kpa", "q"}, faults);
  EXPECT_TRUE(faults.empty());
  table.require("p_1_pa", faults);
  EXPECT_EQ(faults.faults(), std::vector<std::string>(
      {"column p_1_pa has '[kPa]' in the row of units: must be the unit in its name"}));
  EXPECT_EQ(readAll(table, 3).numbers, std::vector<double>({3.0}));
  std::istringstream lost("a,b\nnan,nan\n1,2\n");  // no units
  CsvTable with_lost(lost);
  EXPECT_EQ(readAll(with_lost, 0).faults.size(), 1u);
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
