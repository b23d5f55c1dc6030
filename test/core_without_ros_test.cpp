// The core includes nothing of ROS: only the folders ros/, bags/ and programs/ may.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

namespace live_stiffness {
namespace {

namespace fs = std::filesystem;

// Headers of ROS packages, and the package's own generated messages (UpperCamel).
bool isRosInclude(const std::string& line) {
  static const std::regex pattern(
      R"(^\s*#\s*include\s*["<])"
      R"((ros/|rosbag/|tf/|tf2|topic_tools/|diagnostic_updater/|[a-z0-9_]+_msgs/|live_stiffness/[A-Z]).*)");
  return std::regex_match(line, pattern);
}

bool mayUseRos(const fs::path& path) {
  for (const fs::path& part : path)
    if (part == "ros" || part == "bags" || part == "programs") return true;
  return false;
}

TEST(CoreWithoutRos, RecognisesRosIncludes) {
  for (const char* line : {"#include <ros/ros.h>", "#include \"geometry_msgs/PoseStamped.h\"",
                           "# include <tf2/utils.h>", "#include <tf2_ros/buffer.h>",
                           "#include <live_stiffness/StiffnessEstimate.h>"})
    EXPECT_TRUE(isRosInclude(line)) << line;
  for (const char* line : {"#include <vector>", "#include \"live_stiffness/rod/scene.h\"", "// see ros/ and tf2"})
    EXPECT_FALSE(isRosInclude(line)) << line;
}

TEST(CoreWithoutRos, IncludesNoRosHeader) {
  int scanned = 0;
  for (const char* top : {"include/live_stiffness", "src"}) {
    const fs::path folder = fs::path(SOURCE_DIR) / top;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      const fs::path path = fs::relative(entry.path(), folder);
      if (!entry.is_regular_file() || mayUseRos(path)) continue;
      ++scanned;
      std::ifstream file(entry.path());
      std::string line;
      for (int number = 1; std::getline(file, line); ++number)
        EXPECT_FALSE(isRosInclude(line)) << entry.path().string() << ":" << number << ": " << line
                                         << "\nmove it to the ros/ folder, or convert there";
    }
  }
  EXPECT_GT(scanned, 25);  // else the scan looked in the wrong place
}

}  // namespace
}  // namespace live_stiffness
