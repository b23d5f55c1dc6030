#include "support/shared_data.h"

#include <cstdlib>
#include <filesystem>

namespace live_stiffness {

std::optional<std::string> sharedDataFile(const std::string& name) {
  const char* given = std::getenv("LIVE_STIFFNESS_DATA");
  const std::filesystem::path folder =
      given ? std::filesystem::path(given) : std::filesystem::path(SOURCE_DIR) / ".." / "shared" / "data";
  const std::filesystem::path path = folder / name;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  return path.string();
}

}  // namespace live_stiffness
