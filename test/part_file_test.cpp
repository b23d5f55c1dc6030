#include "part_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

namespace fs = std::filesystem;

class PartFileTest : public ::testing::Test {
 protected:
  PartFileTest() : folder_(fs::path(testing::TempDir()) / "part_file_test") {
    fs::remove_all(folder_);
    fs::create_directory(folder_);
  }
  ~PartFileTest() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

TEST_F(PartFileTest, TakesItsPlaceOnlyWhenFinished) {
  writeTextFile("text", path("a"), "old");
  {
    PartFile part(path("a"));
    std::ofstream(part.writePath()) << "half";
  }
  EXPECT_EQ(readTextFile("text", path("a")), "old");
  EXPECT_FALSE(fs::exists(path("a.part")));
  writeTextFile("text", path("a"), "new");
  EXPECT_EQ(readTextFile("text", path("a")), "new");
  EXPECT_FALSE(fs::exists(path("a.part")));
}

TEST_F(PartFileTest, LeavesALinkAndWritesToWhatItPointsTo) {
  writeTextFile("text", path("target"), "old");
  fs::create_symlink(path("target"), path("link"));
  writeTextFile("text", path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(readTextFile("text", path("target")), "new");
}

TEST_F(PartFileTest, WritesToADeviceDirectlyAndSaysWhenItIsFull) {
  EXPECT_NO_THROW(writeTextFile("text", "/dev/null", "gone"));
  EXPECT_TRUE(fs::is_character_file("/dev/null")) << "was replaced";
  if (fs::exists("/dev/full")) {
    EXPECT_THROW(writeTextFile("text", "/dev/full", "too much"), ConfigurationError);
  }
}

TEST_F(PartFileTest, NamesWhyItCannotBeWritten) {
  EXPECT_NE(writeFault(path("none/a")).find("is its folder there?"), std::string::npos);
  EXPECT_NE(writeFault(folder_.string()).find("is a folder"), std::string::npos);
}

}  // namespace
}  // namespace live_stiffness
