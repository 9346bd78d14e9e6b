#include "plugins/common/frames/static_frames.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "plugins/common/ros/sensor_places.hpp"

namespace cairn::ros {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::HasSubstr;

const Quaterniond kAsItIs = Quaterniond::Identity();

Quaterniond turned(double angle_rad, const Vector3d& axis = Vector3d::UnitZ()) {
  return Quaterniond(AngleAxisd(angle_rad, axis));
}

TEST(StaticFrames, HangOnEachOther) {
  frames::StaticFrames frames;
  EXPECT_TRUE(frames.add("base_footprint", "base_link", {0.0, 0.0, 0.1}, kAsItIs));
  EXPECT_TRUE(frames.add("base_link", "mast", {0.2, 0.0, 0.5}, turned(std::numbers::pi / 2)));
  EXPECT_TRUE(frames.add("mast", "laser", {0.1, 0.0, 0.0}, kAsItIs));
  const auto laser = frames.find("base_footprint", "laser");
  ASSERT_TRUE(laser);
  EXPECT_NEAR(laser->T_base_sensor.x_m, 0.2, 1e-9);
  EXPECT_NEAR(laser->T_base_sensor.y_m, 0.1, 1e-9);
  EXPECT_NEAR(laser->T_base_sensor.theta_rad, std::numbers::pi / 2, 1e-9);
  EXPECT_FALSE(laser->is_upside_down);
  EXPECT_NEAR(frames.find("mast", "base_link")->T_base_sensor.y_m, 0.2, 1e-9) << "downwards too";
  EXPECT_EQ(frames.find("base_link", "base_link")->T_base_sensor.x_m, 0.0);
  EXPECT_FALSE(frames.find("base_link", "sonar"));
}

TEST(StaticFrames, KnowWhatHangsUpsideDownAndWhatLooksUp) {
  frames::StaticFrames frames;
  EXPECT_TRUE(frames.add("base", "below", {0.0, 0.0, 0.0}, turned(std::numbers::pi, Vector3d::UnitX())));
  EXPECT_TRUE(frames.add("base", "up", {0.0, 0.0, 0.0}, turned(-std::numbers::pi / 2, Vector3d::UnitY())));
  EXPECT_TRUE(frames.find("base", "below")->is_upside_down);
  EXPECT_FALSE(frames.find("base", "up"));
}

TEST(StaticFrames, TakeNothingThatIsNoPoseAndNeverMoreThanTheyMay) {
  frames::StaticFrames frames;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int axis = 0; axis < 3; ++axis) {
    Vector3d position_m = Vector3d::Zero();
    position_m[axis] = nan;
    EXPECT_FALSE(frames.add("base", "laser", position_m, kAsItIs)) << "axis " << axis;
  }
  EXPECT_FALSE(frames.add("base", "laser", {1e9, 0.0, 0.0}, kAsItIs));
  EXPECT_FALSE(frames.add("base", "laser", {0.0, 0.0, 0.0}, Quaterniond(0.0, 0.0, 0.0, 0.0)));
  EXPECT_FALSE(frames.add("base", "base", {0.0, 0.0, 0.0}, kAsItIs));
  EXPECT_FALSE(frames.add("", "laser", {0.0, 0.0, 0.0}, kAsItIs));
  EXPECT_TRUE(frames.names().empty());
  for (std::size_t i = 0; i < frames::StaticFrames::kMaxFrames; ++i)
    EXPECT_TRUE(frames.add("base", "f" + std::to_string(i), {0.0, 0.0, 0.0}, kAsItIs));
  EXPECT_FALSE(frames.add("base", "one_more", {0.0, 0.0, 0.0}, kAsItIs));
  EXPECT_TRUE(frames.add("base", "f0", {1.0, 0.0, 0.0}, kAsItIs)) << "one that is known may move";
}

TEST(StaticFrames, ACircleLeadsNowhere) {
  frames::StaticFrames frames;
  EXPECT_TRUE(frames.add("a", "b", {0.0, 0.0, 0.0}, kAsItIs));
  EXPECT_TRUE(frames.add("b", "a", {0.0, 0.0, 0.0}, kAsItIs));
  EXPECT_FALSE(frames.find("a", "b"));
}

void add_frame(SensorPlaces& places, const std::string& parent, const std::string& child, double x_m) {
  EXPECT_TRUE(places.add(parent, child, {x_m, 0.0, 0.0}, kAsItIs));
}

std::string refusal_of(auto act) {
  try {
    act();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(SensorPlaces, AreTheFilesUnlessFramesSayOtherwise) {
  SensorPlaces places{RobotTopics{}};
  places.found_base("base_link");
  const Pose2 by_file{0.1, 0.0, 0.0};
  EXPECT_EQ(places.of_sensor("sonar", by_file, 0.0)->T_base_sensor, by_file) << "a frame that nobody knows";
  add_frame(places, "base_link", "sonar", 0.12);
  EXPECT_EQ(places.of_sensor("sonar", by_file, 0.0)->T_base_sensor, by_file) << "near enough";
  add_frame(places, "base_link", "sonar", 0.3);
  EXPECT_THAT(refusal_of([&] { (void)places.of_sensor("sonar", by_file, 0.0); }),
              HasSubstr("the sensor \"sonar\" is at (0.30, 0.00) m, 0 deg from \"base_link\" by /tf_static, and at "
                        "(0.10, 0.00) m, 0 deg by the robot's file"));
}

TEST(SensorPlaces, AreTheFilesAloneOrTheFramesAloneWhenTheSettingsSaySo) {
  RobotTopics config;
  config.mounting = Mounting::file;
  SensorPlaces file(config);
  add_frame(file, "base_link", "sonar", 9.0);
  file.found_base("base_link");
  EXPECT_EQ(file.of_sensor("sonar", {0.1, 0.0, 0.0}, 0.0)->T_base_sensor.x_m, 0.1);
  config.mounting = Mounting::frames;
  config.base_frame = "base_link";
  SensorPlaces frames(config);
  frames.found_base("base_footprint");
  EXPECT_FALSE(frames.of_sensor("sonar", {0.1, 0.0, 0.0}, 10.0)) << "not known yet";
  add_frame(frames, "base_link", "sonar", 9.0);
  EXPECT_EQ(frames.of_sensor("sonar", {0.1, 0.0, 0.0}, 11.0)->T_base_sensor.x_m, 9.0);
}

TEST(SensorPlaces, AFrameThatDoesNotBecomeKnownIsAFaultWithThoseThatAre) {
  SensorPlaces places{RobotTopics{}};
  places.found_base("base_link");
  add_frame(places, "base_link", "sonars", 0.2);
  EXPECT_FALSE(places.of_frame("sonar", 10.0));
  EXPECT_THAT(refusal_of([&] { (void)places.of_frame("sonar", 15.1); }),
              HasSubstr("/tf_static does not say where the frame \"sonar\" is on \"base_link\" (did you mean "
                        "\"sonars\"?); known are: base_link, sonars"));
  EXPECT_NEAR(places.of_frame("sonars", 16.0)->T_base_sensor.x_m, 0.2, 1e-9);
  EXPECT_EQ(places.of_frame("base_link", 16.0)->T_base_sensor.x_m, 0.0);
}

TEST(SensorPlaces, AFrameThatIsKnownDoesNotMakeUpForOneThatIsNot) {
  RobotTopics config;
  config.mounting = Mounting::frames;
  SensorPlaces places(config);
  places.found_base("base_link");
  add_frame(places, "base_link", "left", 0.2);
  const auto see_both = [&](double now_s) {
    (void)places.of_sensor("left", {}, now_s);
    (void)places.of_sensor("right", {}, now_s);
  };
  see_both(10.0);
  see_both(14.0);
  EXPECT_THAT(refusal_of([&] { see_both(15.1); }), HasSubstr("does not say where the frame \"right\" is"));
}

TEST(SensorPlaces, FramesThatNobodyReadsAreAFaultThatNamesTheSetting) {
  RobotTopics config;
  config.mounting = Mounting::frames;
  config.static_frames = "";
  SensorPlaces places(config);
  places.found_base("base_link");
  (void)places.of_sensor("sonar", {}, 0.0);
  EXPECT_THAT(refusal_of([&] { (void)places.of_sensor("sonar", {}, 6.0); }), HasSubstr("`static_frames` is empty"));
}

}  // namespace
}  // namespace cairn::ros
