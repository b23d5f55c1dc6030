#pragma once
// Where the shared recordings and reference numbers are. They are not part of the repository.

#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

namespace live_stiffness {

// Path of a file in the shared data, such as "stiff_flop_recordings/no_load.csv"; empty when it is not there. Looks in
// $LIVE_STIFFNESS_DATA if that is set, and beside the source tree otherwise.
inline std::optional<std::string> sharedDataFile(const std::string& name) {
  const char* folder = std::getenv("LIVE_STIFFNESS_DATA");
  const std::string path = (folder ? std::string(folder) : std::string(SOURCE_DIR) + "/../shared/data") + "/" + name;
  return std::ifstream(path) ? std::optional<std::string>(path) : std::nullopt;
}

}  // namespace live_stiffness
