#include "plugins/common/ros/heard_topics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::ros {
namespace {

using testing::HasSubstr;

std::string text_of(const std::vector<ConnectionValue>& values) {
  std::string text;
  for (const ConnectionValue& value : values) text += value.name + " " + value.text + "\n";
  return text;
}

TEST(HeardTopics, SayRateAgeFramesAndClock) {
  HeardTopics heard;
  for (int i = 0; i <= 20; ++i)
    heard.add("/scan", 100.0 + 0.1 * i, i % 2 == 0 ? "laser" : "mast", 5000.0 + 0.1 * i - 0.02, 5000.0 + 0.1 * i);
  EXPECT_EQ(text_of(heard.values_of("/scan", 102.5)),
            "rate 10.0 a second\nage 0.50 s\nframe laser mast\nclock -0.020 s of this computer's\n");
}

TEST(HeardTopics, TheClockIsOfTheMessageThatCameFastest) {
  HeardTopics heard;
  heard.add("/odom", 1.0, "", 99.0, 100.0);
  heard.add("/odom", 2.0, "", 100.99, 101.0);
  heard.add("/odom", 3.0, "", 101.5, 102.0);
  EXPECT_NEAR(*heard.find("/odom")->ahead_s, -0.01, 1e-9);
}

TEST(HeardTopics, WithoutAHeaderThereIsNeitherFrameNorClock) {
  HeardTopics heard;
  heard.add("/bumper", 7.0);
  EXPECT_EQ(text_of(heard.values_of("/bumper", 8.0)), "age 1.00 s\n");
  EXPECT_EQ(text_of(heard.values_of("/other", 8.0)), "heard nothing\n");
  EXPECT_EQ(heard.find("/other"), nullptr);
}

TEST(HeardTopics, AClockThatIsFarOffIsSimulatedOrWasNeverSet) {
  HeardTopics heard;
  heard.add("/odom", 1.0, "odom", 12.0, 1.7e9);
  EXPECT_THAT(text_of(heard.values_of("/odom", 1.0)), HasSubstr("clock simulated, or never set"));
}

TEST(HeardTopics, FramesAreListedUpToFourAndKeptUpToTheirLimit) {
  HeardTopics heard;
  for (int i = 0; i < 200; ++i) heard.add("/sonar", i, "sonar_" + std::to_string(100 + i), 0.0, 0.0);
  EXPECT_EQ(heard.find("/sonar")->frames.size(), HeardTopics::kMaxFrames);
  EXPECT_THAT(text_of(heard.values_of("/sonar", 200.0)),
              HasSubstr("frame sonar_100 sonar_101 sonar_102 sonar_103 and 60 more"));
}

TEST(HeardTopics, StampsThatAreNotUsedBesideTheOdometryAreNamed) {
  HeardTopics heard;
  heard.add("/odom", 1.0, "odom", 100.0, 100.0);
  for (const double ahead_s : {-0.9, 0.0, 0.25}) {
    HeardTopics near = heard;
    near.add("/scan", 1.0, "laser", 100.0 + ahead_s, 100.0);
    EXPECT_EQ(near.clocks_apart("/scan", "/odom"), "") << ahead_s;
  }
  HeardTopics behind = heard;
  behind.add("/scan", 1.0, "laser", 95.0, 100.0);
  EXPECT_THAT(behind.clocks_apart("/scan", "/odom"), HasSubstr("its stamps are 5.00 s behind those of /odom"));
  HeardTopics ahead = heard;
  ahead.add("/scan", 1.0, "laser", 100.5, 100.0);
  EXPECT_THAT(ahead.clocks_apart("/scan", "/odom"), HasSubstr("0.50 s ahead of those of /odom"));
  EXPECT_EQ(heard.clocks_apart("/scan", "/odom"), "") << "not known";
}

}  // namespace
}  // namespace cairn::ros
