#pragma once
// Reference data that lives beside the repository and is not part of it.

#include <optional>
#include <string>

namespace live_stiffness {

// Path of a file of the shared data folder, or nothing when it is not there. The folder is the environment variable
// LIVE_STIFFNESS_DATA if set, else shared/data beside the source folder.
std::optional<std::string> sharedDataFile(const std::string& name);

}  // namespace live_stiffness

// Skips the running test when the file is absent.
#define SKIP_WITHOUT(path, name)                                                                   \
  if (!(path))                                                                                     \
  GTEST_SKIP() << (name) << " not found: set LIVE_STIFFNESS_DATA to the folder of the shared data"
