#pragma once
// Files that are there whole or not at all: written beside their place, and moved there when all of it is on disk.

#include <string>

namespace live_stiffness {

class PartFile {
 public:
  // path: final name. What is no regular file (a pipe, /dev/stdout) is written to directly.
  explicit PartFile(std::string path);
  // Removes what was written unless it was finished.
  ~PartFile();
  PartFile(const PartFile&) = delete;

  // Where to write: the final name with .part.
  const std::string& writePath() const { return part_; }
  // All has been written and closed: gives it its name. Throws ConfigurationError if that fails.
  void finish();

 private:
  std::string path_, part_;
  bool finished_ = false;
};

// Why a file cannot be written, as far as can be said: whether its folder is there, and what is left on its disk.
std::string writeFault(const std::string& path);

// Writes a text whole or not at all. Throws ConfigurationError with subject (such as "scene"), path and reason.
void writeTextFile(const std::string& subject, const std::string& path, const std::string& text);

}  // namespace live_stiffness
