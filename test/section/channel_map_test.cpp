#include "live_stiffness/section/channel_map.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "live_stiffness/checks.h"

namespace live_stiffness {
namespace {

size_t faultCount(const std::vector<int>& channel_of_chamber) {
  try {
    ChannelMap{channel_of_chamber};
  } catch (const ConfigurationError& error) {
    return error.faults().size();
  }
  return 0;
}

TEST(ChannelMap, CopiesEachChannelToItsChambers) {
  const ChannelMap map({2, 0, 1, 0});
  EXPECT_EQ(map.channelCount(), 3);
  EXPECT_EQ(map.chamberCount(), 4);
  EXPECT_EQ(map.expand(Vector3(10.0, 20.0, 30.0)), Eigen::Vector4d(30.0, 10.0, 20.0, 10.0));
}

TEST(ChannelMap, EvenPairsNeighbours) {
  EXPECT_EQ(ChannelMap::even(3, 6).channelOfChamber(), (std::vector<int>{0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(ChannelMap::even(4, 4).channelOfChamber(), (std::vector<int>{0, 1, 2, 3}));
}

TEST(ChannelMap, EvenRefusesWhatDoesNotDivide) {
  EXPECT_THROW(ChannelMap::even(4, 6), ConfigurationError);
  EXPECT_THROW(ChannelMap::even(6, 3), ConfigurationError);
  EXPECT_THROW(ChannelMap::even(0, 6), ConfigurationError);
  EXPECT_THROW(ChannelMap::even(3, 0), ConfigurationError);
}

TEST(ChannelMap, ReportsAllFaultsAtOnce) {
  EXPECT_EQ(faultCount({}), 1u);
  EXPECT_EQ(faultCount({0, -1, kMaxChannels}), 2u);
  EXPECT_EQ(faultCount({-1, 1}), 1u);
  EXPECT_EQ(faultCount({0, 0, 1, 1, 2, 2}), 0u);
}

// Of a valve terminal with twelve outlets.
TEST(ChannelMap, LeavesSpareChannelsAlone) {
  const ChannelMap map({4, 5, 3});
  EXPECT_EQ(map.channelCount(), 6);
  EXPECT_EQ(map.expand(Pressures::LinSpaced(12, 0.0, 11.0)), Vector3(4.0, 5.0, 3.0));
}

TEST(ChannelMap, ExpandRefusesTooFewChannels) {
  const ChannelMap map = ChannelMap::even(3, 6);
  EXPECT_THROW(map.expand(Pressures::Zero(2)), std::invalid_argument);
  Pressures chambers = Pressures::Constant(6, 7.0);
  EXPECT_FALSE(map.expandInto(Pressures::Zero(2), chambers));
  EXPECT_EQ(chambers, Pressures::Constant(6, 7.0));
  Pressures too_few(5);
  EXPECT_FALSE(map.expandInto(Pressures::Zero(3), too_few));
}

}  // namespace
}  // namespace live_stiffness
