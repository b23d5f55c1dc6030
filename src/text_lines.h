#pragma once
// Lines of a text, whichever program has written it: UTF-8 or UTF-16, with or without a byte order mark, lines that end with
// LF, CR LF or CR.

#include <istream>
#include <sstream>
#include <string>

namespace live_stiffness {

class TextLines {
 public:
  // `input` has to outlive it; a UTF-16 text is read as a whole, any other line by line.
  explicit TextLines(std::istream& input) : bytes_(input.rdbuf()) {}

  // The next line without its end; false at the end of the text. Of UTF-16, characters beyond ASCII become question marks.
  bool next(std::string& line);
  // Of the newest line, from 1.
  long number() const { return number_; }

 private:
  void decodeUtf16();

  std::streambuf* bytes_;
  std::stringbuf decoded_;
  long number_ = 0;
  bool after_return_ = false;
};

}  // namespace live_stiffness
