#include "part_file.h"

#include <filesystem>
#include <fstream>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace fs = std::filesystem;

PartFile::PartFile(std::string path) : path_(std::move(path)) {
  std::error_code ignored;
  const bool is_special = fs::exists(path_, ignored) && !fs::is_regular_file(path_, ignored);
  if (!is_special && fs::is_symlink(path_, ignored)) {  // write to where it points, and leave the link
    const fs::path target = fs::weakly_canonical(path_, ignored);
    if (!target.empty()) path_ = target.string();
  }
  part_ = is_special ? path_ : path_ + ".part";
}

PartFile::~PartFile() {
  std::error_code ignored;
  if (!finished_ && part_ != path_) fs::remove(part_, ignored);
}

void PartFile::finish() {
  std::error_code error;
  if (part_ != path_) fs::rename(part_, path_, error);
  if (error) throw ConfigurationError("output " + path_, {"cannot be written: " + error.message()});
  finished_ = true;
}

std::string writeFault(const std::string& path) {
  const fs::path folder = fs::absolute(path).parent_path();
  std::error_code error;
  if (fs::is_directory(path, error)) return "cannot be written: it is a folder";
  if (!fs::is_directory(folder, error)) return "cannot be written: is its folder there?";
  const fs::space_info space = fs::space(folder, error);
  constexpr std::uintmax_t kLittle = 1 << 20;  // bytes
  if (!error && space.available < kLittle)
    return "cannot be written: " + std::to_string(space.available) + " bytes are left on its disk";
  return "cannot be written: is its folder writable, and is there space on its disk?";
}

void writeTextFile(const std::string& subject, const std::string& path, const std::string& text) {
  PartFile part(path);
  std::ofstream file(part.writePath());
  file << text;
  file.close();
  if (!file) throw ConfigurationError(subject + " " + path, {writeFault(path)});
  part.finish();
}

}  // namespace live_stiffness
