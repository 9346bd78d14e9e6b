#include "plugins/picture_log/picture_log.hpp"

#include <gmock/gmock.h>

#include "tests/plugins/common/pictures/written_pictures.hpp"
#include "tests/plugins/log_files.hpp"

namespace cairn::picture_log {
namespace {

using testing::HasSubstr;
using written_pictures::jpeg;
using written_pictures::png;
using written_pictures::ramp;

// An observation each half second from 100 s on, by a clock that begins at 0.
std::shared_ptr<Sensor> log_of(int observations) {
  class Log final : public Sensor {
   public:
    explicit Log(int observations) : observations_(observations) {}
    SensorStep next(const Budget&) override {
      SensorStep step;
      if (next_ == observations_) {
        step.reason = "end";
        return step;
      }
      step.state = SensorState::observation;
      step.observation.stamp_s = 0.5 * next_++;
      step.observation.recorded_s = 100.0 + step.observation.stamp_s;
      return step;
    }

   private:
    int observations_;
    int next_ = 0;
  };
  return std::make_shared<Log>(observations);
}

RobotModel robot() {
  RobotModel robot;
  robot.cameras.resize(2);
  for (CameraModel& camera : robot.cameras) {
    camera.width_px = 20;
    camera.height_px = 10;
  }
  return robot;
}

struct Played {
  std::vector<Observation> seen;
  std::string reason;
};

class PictureLog : public testing::Test {
 protected:
  Played played(const Config& config, bool wants_images = true) {
    SensorContext context{{robot()}};
    context.wants_images = wants_images;
    Played played;
    try {
      const auto log = with_pictures(log_of(5), config, context);
      SensorStep step;
      for (step = log->next({}); step.state == SensorState::observation; step = log->next({}))
        played.seen.push_back(step.observation);
      played.reason = folder_.without_folder((step.state == SensorState::fault ? "fault: " : "") + step.reason);
    } catch (const ConfigError& error) {
      played.reason = folder_.without_folder(error.what());
    }
    return played;
  }
  std::string refusal(const std::string& list, int camera = 0) {
    return played({{}, {{folder_.write("list.txt", list), camera, 0.0}}}).reason;
  }

  log_files::LogFolder folder_;
};

TEST_F(PictureLog, EachPictureGoesWithTheObservationNextAfterIt) {
  (void)folder_.write("a.png", png(20, 10, ramp(20, 10)));
  (void)folder_.write("b.jpg", jpeg(20, 10, ramp(20, 10)));
  const auto tum =
      folder_.write("rgb.txt", "# colour images\n# timestamp filename\n100.9 b.jpg\n100.25 a.png\n100.5 a.png\n");
  const auto csv = folder_.write("stamps.csv", "stamp_s,file\n90.75, a.png\n95.0, a.png\n80.0, a.png\n");
  const Config config{{}, {{tum, 0, 0.0}, {csv, 1, 10.0}}};
  const Played log = played(config);
  ASSERT_EQ(log.seen.size(), 5U) << log.reason;
  EXPECT_EQ(log.seen[0].images.size(), 0U);
  ASSERT_EQ(log.seen[1].images.size(), 2U);
  EXPECT_EQ(log.seen[1].images[0].camera, 0);
  EXPECT_DOUBLE_EQ(log.seen[1].images[0].stamp_s, 0.25) << "by the observations' clock";
  EXPECT_EQ(*log.seen[1].images[0].grey, ramp(20, 10));
  EXPECT_DOUBLE_EQ(log.seen[1].images[1].stamp_s, 0.5);
  ASSERT_EQ(log.seen[2].images.size(), 2U);
  EXPECT_EQ(log.seen[2].images[0].camera, 1);
  EXPECT_DOUBLE_EQ(log.seen[2].images[0].stamp_s, 0.75);
  EXPECT_EQ(log.seen[2].images[1].camera, 0);
  EXPECT_EQ(log.reason, "end; 2 pictures without an observation within 1 s after it");
}

TEST_F(PictureLog, PicturesThatNobodyWantsAreNotLookedFor) {
  const Played log = played({{}, {{"/nowhere/list.txt", 7, 0.0}}}, false);
  ASSERT_EQ(log.seen.size(), 5U);
  for (const Observation& seen : log.seen) EXPECT_TRUE(seen.images.empty());
  EXPECT_EQ(log.reason, "end");
}

TEST_F(PictureLog, WhatIsWrongIsSaidWithItsLine) {
  (void)folder_.write("a.png", png(20, 10, ramp(20, 10)));
  (void)folder_.write("small.png", png(10, 10, ramp(10, 10)));
  (void)folder_.write("broken.png", png(20, 10, ramp(20, 10)).substr(0, 40));
  EXPECT_EQ(refusal("100 a.png\n100.5 none.png\n"), "list.txt:2:7: no such picture: none.png");
  EXPECT_EQ(refusal("100 a.png\nsoon a.png\n"), "list.txt:2:1: the stamp must be a number, not \"soon\"");
  EXPECT_EQ(refusal("100\n"), "list.txt:1:1: a picture is a stamp and a file, and the line has 1 word");
  EXPECT_EQ(refusal("# none\n"), "list.txt: the list names no picture");
  EXPECT_EQ(refusal("100 a.png\n", 2), "list.txt: pictures of camera 2, and the robot's file has 2 (from 0)");
  EXPECT_THAT(refusal("100 broken.png\n"), HasSubstr("fault: list.txt:1:5: broken.png: the PNG cannot be read"));
  EXPECT_EQ(
      refusal("100 a.png\n100.5 small.png\n"),
      "fault: list.txt:2:7: small.png: a picture of 10 x 10 pixels, and its camera in the robot's file has 20 x 10");
}

}  // namespace
}  // namespace cairn::picture_log
