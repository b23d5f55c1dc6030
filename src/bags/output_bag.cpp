#include "bags/output_bag.h"

#include <vector>

#include "live_stiffness/checks.h"

namespace live_stiffness {

OutputBag::OutputBag(const std::string& path) : path_(path), part_(path), bag_(std::make_unique<rosbag::Bag>()) {
  guard([&] { bag_->open(part_.writePath(), rosbag::bagmode::Write); });
}

OutputBag::~OutputBag() { abandon(); }

void OutputBag::finish() {
  guard([&] { bag_->close(); });
  part_.finish();
}

// Closes a bag that is not needed. If the disk is full, closing throws; it would throw again in rosbag's destructor, which
// would end the program. So such a bag is never destroyed.
void OutputBag::abandon() {
  if (bag_ == nullptr) return;
  try {
    bag_->close();
  } catch (const std::exception&) {
    static std::vector<rosbag::Bag*> never_closed;
    never_closed.push_back(bag_.release());
  }
  bag_.reset();
}

void OutputBag::fail(const std::string& reason) {
  const std::string why = writeFault(path_) + " (rosbag: " + reason + ")";
  abandon();
  throw ConfigurationError("bag " + path_, {why});
}

}  // namespace live_stiffness
