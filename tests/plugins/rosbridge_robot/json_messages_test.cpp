#include "plugins/rosbridge_robot/json_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace cairn::rosbridge_robot {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

const char* const kHeader2 = R"("header":{"stamp":{"sec":12,"nanosec":500000000},"frame_id":"laser"})";
const char* const kHeader1 = R"("header":{"seq":3,"stamp":{"secs":12,"nsecs":500000000},"frame_id":"/laser"})";

json parsed(const std::string& members) {
  return json::parse("{" + members + "}");
}

std::string refusal_of(auto read) {
  try {
    (void)read();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(JsonMessages, HeadersOfBothVersionsAreRead) {
  for (const char* text : {kHeader1, kHeader2}) {
    const ros::Header header = header_in(parsed(text));
    EXPECT_EQ(header.stamp_s, 12.5);
    EXPECT_EQ(header.frame, "laser") << "without the slash of old drivers";
  }
  EXPECT_EQ(
      refusal_of([] { return header_in(parsed(R"("header":{"stamp":{"sec":null,"nanosec":0},"frame_id":""})")); }),
      "its `header.stamp` is no time");
}

TEST(JsonMessages, ScansHaveNullForWhatJsonDoesNotHave) {
  const json msg =
      parsed(std::string(kHeader2) + R"(,"angle_min":-1,"angle_max":1,"angle_increment":0.5,"range_min":0.1,
    "range_max":null,"ranges":[1.5,null,2],"intensities":[])");
  std::vector<float> ranges_m;
  const ros::Scan scan = scan_in(msg, kNoNumber, ranges_m);
  EXPECT_EQ(scan.angle_min_rad, -1.0);
  EXPECT_EQ(scan.max_m, 0.0) << "not known";
  ASSERT_EQ(scan.ranges_m.size(), 3U);
  EXPECT_EQ(scan.ranges_m[0], 1.5F);
  EXPECT_TRUE(std::isnan(scan.ranges_m[1]));
  EXPECT_TRUE(std::isinf(scan_in(msg, std::numeric_limits<double>::infinity(), ranges_m).ranges_m[1]));
}

TEST(JsonMessages, AFieldThatIsMissingOrSomethingElseIsNamed) {
  EXPECT_EQ(refusal_of([] { return range_in(parsed(kHeader2), kNoNumber); }), "it has no `min_range`");
  EXPECT_EQ(refusal_of([] { return odometry_in(json(7)); }), "it has no `header.stamp`");
  EXPECT_EQ(refusal_of([] {
              return odometry_in(parsed(std::string(kHeader2) + R"(,"child_frame_id":"b","pose":{"pose":[]})"));
            }),
            "it has no `pose.pose.position.x`");
  EXPECT_EQ(refusal_of([] { return bool_in(parsed(R"("data":1)")); }), "its `data` is neither true nor false");
  std::vector<float> ranges_m;
  EXPECT_EQ(refusal_of(
                [&] { return scan_in(parsed(std::string(kHeader2) + R"(,"ranges":[1,"two"])"), kNoNumber, ranges_m); }),
            "its `ranges` is no number");
}

TEST(JsonMessages, CompassesBatteriesCloudsAndFramesAreRead) {
  const json imu =
      parsed(R"("orientation":{"x":0,"y":0,"z":0.6,"w":0.8},"orientation_covariance":[-1,0,0,0,0,0,0,0,0])");
  EXPECT_FALSE(imu_in(imu).has_orientation);
  EXPECT_EQ(imu_in(imu).orientation.z, 0.6);
  EXPECT_EQ(field_in(parsed(R"("magnetic_field":{"x":1e-5,"y":2e-5,"z":0})")).y_t, 2e-5);
  EXPECT_TRUE(std::isnan(percentage_in(parsed(R"("percentage":null)"))));
  EXPECT_EQ(percentage_in(parsed(R"("percentage":0.5)")), 0.5);
  EXPECT_TRUE(bool_in(parsed(R"("data":true)")));
  EXPECT_EQ(points_in(parsed(R"("points":[{"x":1,"y":2,"z":3}])"))[0], Point(1.0, 2.0));
  const auto frames = frames_in(parsed(R"("transforms":[{"header":{"frame_id":"/base"},"child_frame_id":"laser",
    "transform":{"translation":{"x":0.1,"y":0.2,"z":0.3},"rotation":{"x":0,"y":0,"z":0,"w":1}}}])"));
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].parent, "base");
  EXPECT_EQ(frames[0].child, "laser");
  EXPECT_EQ(frames[0].position_m.z(), 0.3);
  EXPECT_EQ(frames[0].rotation.w(), 1.0);
}

TEST(JsonMessages, TypesAreNamedAsTheVersionHasThem) {
  EXPECT_EQ(type_name("nav_msgs/Odometry", 1), "nav_msgs/Odometry");
  EXPECT_EQ(type_name("nav_msgs/Odometry", 2), "nav_msgs/msg/Odometry");
}

TEST(JsonMessages, VelocitiesAreOfTheTypeThatIsWanted) {
  const json plain = json::parse(velocity_text({"/cmd_vel", CommandKind::twist, "base"}, {0.25, -0.5}));
  EXPECT_EQ(plain["op"], "publish");
  EXPECT_EQ(plain["topic"], "/cmd_vel");
  EXPECT_EQ(plain["msg"]["linear"]["x"], 0.25);
  EXPECT_EQ(plain["msg"]["angular"]["z"], -0.5);
  EXPECT_EQ(plain["msg"]["linear"]["z"], 0.0);
  const json stamped = json::parse(velocity_text({"/cmd_vel", CommandKind::twist_stamped, "base"}, {0.25, -0.5}));
  EXPECT_EQ(stamped["msg"]["twist"], plain["msg"]);
  EXPECT_EQ(stamped["msg"]["header"], json({{"frame_id", "base"}})) << "the stamp is rosbridge's";
}

}  // namespace
}  // namespace cairn::rosbridge_robot
