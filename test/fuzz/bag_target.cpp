// Bags: refused with a ConfigurationError, or a recording that is sound; rosbag, which reads them, believes the lengths
// and places that it finds there.

#include <console_bridge/console.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "live_stiffness/checks.h"
#include "live_stiffness/ros/recorded_bag.h"
#include "recording_checks.h"

using namespace live_stiffness;

namespace {

// A bag is read by its name only. Taken away at the end.
class BagFile {
 public:
  BagFile() : path_(std::filesystem::temp_directory_path() / ("fuzz_bag_" + std::to_string(::getpid()) + ".bag")) {
    console_bridge::noOutputHandler();  // of rosbag, a line each
  }
  ~BagFile() { std::filesystem::remove(path_); }

  std::string with(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary) << bytes;
    return path_.string();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  static const BagFile file;
  try {
    requireSound(loadRecordedBag(file.with(textOf(data, size))));
  } catch (const ConfigurationError& error) {
    require(!error.faults().empty(), "a refusal has a reason");
  }
  return 0;
}
