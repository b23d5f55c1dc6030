#include "text_lines.h"

#include <iterator>

namespace live_stiffness {

constexpr int kEnd = std::char_traits<char>::eof();

bool TextLines::next(std::string& line) {
  if (number_ == 0) decodeUtf16();
  line.clear();
  int byte = bytes_->sbumpc();
  if (byte == '\n' && after_return_) byte = bytes_->sbumpc();
  if (byte == kEnd) return false;
  for (; byte != kEnd && byte != '\n' && byte != '\r'; byte = bytes_->sbumpc()) line += static_cast<char>(byte);
  after_return_ = byte == '\r';
  const std::string mark = "\xEF\xBB\xBF";
  if (++number_ == 1 && line.compare(0, mark.size(), mark) == 0) line.erase(0, mark.size());
  return true;
}

// Its byte order mark begins with a byte that UTF-8 never has.
void TextLines::decodeUtf16() {
  const int first = bytes_->sgetc();
  if (first != 0xFE && first != 0xFF) return;
  const std::string bytes{std::istreambuf_iterator<char>(bytes_), {}};
  std::string text;
  for (size_t k = 2; k + 1 < bytes.size(); k += 2) {
    const char low = bytes[first == 0xFF ? k : k + 1], high = bytes[first == 0xFF ? k + 1 : k];
    text += high == 0 && low >= 0 ? low : '?';
  }
  decoded_.str(text);
  bytes_ = &decoded_;
}

}  // namespace live_stiffness
