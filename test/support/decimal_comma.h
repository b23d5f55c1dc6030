#pragma once
// A process whose numbers have a decimal comma and points between thousands, as beside a nodelet that sets its locale.

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <string>

namespace live_stiffness {

// While it lives, all new streams write 1.234,5.
class DecimalComma {
 public:
  DecimalComma() : before_(std::locale::global(std::locale(std::locale::classic(), new Punctuation))) {}
  ~DecimalComma() { std::locale::global(before_); }

 private:
  struct Punctuation : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  std::locale before_;
};

// The same of C's functions, such as strtod() and snprintf(), in a German locale that is made in `folder`. Not everywhere can
// one be made: then isSet() is false.
class GermanC {
 public:
  explicit GermanC(const std::filesystem::path& folder) : folder_(folder) {
    std::filesystem::create_directories(folder_);
    const std::string command = "localedef -i de_DE -f UTF-8 " + (folder_ / "de_DE.UTF-8").string() + " 2>/dev/null";
    if (std::system(command.c_str()) != 0) return;
    const char* const before = std::getenv("LOCPATH");
    setenv("LOCPATH", folder_.c_str(), 1);
    is_set_ = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr && std::strtod("1.5", nullptr) == 1.0;
    if (before == nullptr) unsetenv("LOCPATH");
    else setenv("LOCPATH", std::string(before).c_str(), 1);
  }
  ~GermanC() {
    std::setlocale(LC_ALL, "C");
    std::filesystem::remove_all(folder_);
  }

  bool isSet() const { return is_set_; }

 private:
  std::filesystem::path folder_;
  bool is_set_ = false;
};

}  // namespace live_stiffness
