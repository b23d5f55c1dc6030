// Bags: refused with a ConfigurationError, or a recording that is sound; rosbag, which reads them, believes the lengths
// and places that it finds there.

#include <console_bridge/console.h>
#include <sys/mman.h>
#include <unistd.h>

#include "live_stiffness/checks.h"
#include "ros/recorded_bag.h"
#include "recording_checks.h"

using namespace live_stiffness;

namespace {

// A bag is read by its name only: of a file that lies in memory.
class BagFile {
 public:
  BagFile() : file_(memfd_create("bag", 0)) {
    require(file_ >= 0, "a file in memory");
    console_bridge::noOutputHandler();  // of rosbag, a line each
  }

  std::string with(const std::uint8_t* data, size_t size) const {
    require(ftruncate(file_, 0) == 0 && pwrite(file_, data, size, 0) == static_cast<ssize_t>(size), "it is written");
    return "/proc/self/fd/" + std::to_string(file_);
  }

 private:
  int file_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  static const BagFile file;
  try {
    requireSound(loadRecordedBag(file.with(data, size)));
  } catch (const ConfigurationError& error) {
    require(!error.faults().empty(), "a refusal has a reason");
  }
  return 0;
}
