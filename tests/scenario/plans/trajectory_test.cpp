// What `cairn plan --trajectory` promises: a drive to the goal within the limits of the robot's file, and its picture.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "framework/files/robot_file.hpp"
#include "tests/maps/pictures/picture_fixture.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;

constexpr double kRounding = 1e-6;

struct Row {
  double time_s;
  Pose2 pose;
  double v_mps;
  double w_radps;
};

class Trajectories : public testing::Test {
 protected:
  // 8 x 6 m with two walls that leave a path in S shape.
  void SetUp() override {
    std::string text = "type octile\nheight 60\nwidth 80\nmap\n";
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x) text += (x / 2 == 13 && y > 20) || (x / 2 == 26 && y < 40) ? '@' : '.';
      text += '\n';
    }
    write_text(file("s.map"), text);
    ASSERT_EQ(run_cairn({"map", "import", file("s.map"), "-o", file("s.cairn"), "--cell-m", "0.1"}).exit_status, 0);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] static std::string robot(const std::string& name) {
    return source_folder() + "/config/robots/" + name + ".yaml";
  }
  // From the lower left room to the upper right one.
  [[nodiscard]] json driven(std::vector<std::string> more) const {
    more.insert(more.begin(), {"plan", file("s.cairn"), "--from", "1,1,90", "--to", "7,5,0", "--trajectory", "--json"});
    const Finished finished = run_cairn(more);
    EXPECT_EQ(finished.exit_status, 0) << finished.err;
    return json::parse(finished.out, nullptr, false);
  }
  [[nodiscard]] json driven_by_car(const std::string& kinematics) const {
    return driven({"--planner", "ompl", "--robot", robot("small_car"), "--set", "footprint=robot", "--set",
                   "kinematics=" + kinematics});
  }

  const std::filesystem::path folder_ = fresh_folder("trajectories");
};

std::vector<Row> rows_of(const json& answer) {
  std::vector<Row> rows;
  for (const json& row : answer.at("trajectory"))
    rows.push_back({row.at(0), {row.at(1), row.at(2), row.at(3)}, row.at(4), row.at(5)});
  return rows;
}

void expect_rests_at_both_ends(const std::vector<Row>& rows, const Pose2& start, const Pose2& goal) {
  for (const auto& [row, pose] : {std::pair{rows.front(), start}, {rows.back(), goal}}) {
    EXPECT_NEAR((row.pose.position() - pose.position()).norm(), 0.0, 1e-3);
    EXPECT_NEAR(wrap_angle(row.pose.theta_rad - pose.theta_rad), 0.0, 1e-3);
    EXPECT_EQ(row.v_mps, 0.0);
    EXPECT_EQ(row.w_radps, 0.0);
  }
  EXPECT_EQ(rows.front().time_s, 0.0);
}

// max_off_rad: where the curvature jumps it changes over the neighbouring steps, so that speeds and headings differ
// for a moment by this much.
void expect_within(const std::vector<Row>& rows, const RobotModel& robot, double max_off_rad) {
  for (const Row& row : rows) {
    EXPECT_LE(std::abs(row.v_mps), robot.max_v_mps + kRounding) << row.time_s;
    EXPECT_LE(std::abs(row.w_radps), robot.max_w_radps + kRounding) << row.time_s;
    EXPECT_LE(std::abs(row.w_radps) * robot.min_turning_radius_m, std::abs(row.v_mps) + kRounding) << row.time_s;
  }
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double dt_s = rows[i].time_s - rows[i - 1].time_s;
    ASSERT_GT(dt_s, 0.0) << rows[i].time_s;
    const double dv_mps = rows[i].v_mps - rows[i - 1].v_mps;
    const double dw_radps = rows[i].w_radps - rows[i - 1].w_radps;
    EXPECT_LE(std::abs(dv_mps), robot.max_acceleration_mps2 * dt_s + kRounding) << rows[i].time_s;
    EXPECT_LE(std::abs(dw_radps), robot.max_turn_acceleration_radps2 * dt_s + kRounding) << rows[i].time_s;
    // It gets as far and turns as much as its speeds, linear in time, say.
    const double way_m = 0.5 * std::abs(rows[i].v_mps + rows[i - 1].v_mps) * dt_s;
    EXPECT_NEAR((rows[i].pose.position() - rows[i - 1].pose.position()).norm(), way_m, 2e-3) << rows[i].time_s;
    const double turn_rad = 0.5 * (rows[i].w_radps + rows[i - 1].w_radps) * dt_s;
    EXPECT_NEAR(wrap_angle(rows[i].pose.theta_rad - rows[i - 1].pose.theta_rad - turn_rad), 0.0, max_off_rad)
        << rows[i].time_s;
  }
}

TEST_F(Trajectories, OfACarKeepItsSpeedsItsAccelerationsAndItsTurningRadius) {
  const RobotModel car = load_robot(robot("small_car"));
  ASSERT_GT(car.min_turning_radius_m, 0.5);
  for (const char* kinematics : {"dubins", "reeds_shepp"}) {
    SCOPED_TRACE(kinematics);
    const std::vector<Row> rows = rows_of(driven_by_car(kinematics));
    ASSERT_GT(rows.size(), 20U);
    expect_rests_at_both_ends(rows, {1.0, 1.0, radians(90.0)}, {7.0, 5.0, 0.0});
    expect_within(rows, car, 0.25 * 0.1 / car.min_turning_radius_m + 1e-3);
    const bool has_reversed = std::ranges::any_of(rows, [](const Row& row) { return row.v_mps < 0.0; });
    EXPECT_TRUE(std::string(kinematics) == "reeds_shepp" || !has_reversed);
  }
}

TEST_F(Trajectories, OfARobotThatTurnsOnTheSpotKeepItsLimits) {
  const RobotModel pioneer = load_robot(robot("pioneer1"));
  const std::vector<Row> rows =
      rows_of(driven({"--planner", "ompl", "--robot", robot("pioneer1"), "--set", "kinematics=differential"}));
  ASSERT_GT(rows.size(), 10U);
  expect_rests_at_both_ends(rows, {1.0, 1.0, radians(90.0)}, {7.0, 5.0, 0.0});
  expect_within(rows, pioneer, 0.1);
}

TEST_F(Trajectories, AreEmptyWithoutARouteAndComeWithEveryQueryThatAsks) {
  write_text(file("q.jsonl"), R"({"from": "1,1", "to": "7,5", "trajectory": true})"
                              "\n"
                              R"({"from": "1,1", "to": "7,5"})"
                              "\n"
                              R"({"from": "1,1", "to": "70,5", "trajectory": true})");
  const Finished finished = run_cairn({"plan", file("s.cairn"), "--queries", file("q.jsonl"), "--json"});
  EXPECT_EQ(finished.exit_status, 1) << finished.err;
  std::istringstream lines(finished.out);
  const auto next = [&] {
    std::string line;
    std::getline(lines, line);
    return json::parse(line, nullptr, false);
  };
  EXPECT_GT(rows_of(next()).size(), 4U);
  EXPECT_FALSE(next().contains("trajectory"));
  EXPECT_EQ(next()["trajectory"], json::array());
}

TEST_F(Trajectories, TheirPictureShowsTheRobot) {
  const auto robot_pixels = [&](const std::vector<std::string>& robot) {
    std::vector<std::string> more{"--planner", "ompl", "--picture", file("route.png")};
    more.insert(more.end(), robot.begin(), robot.end());
    EXPECT_EQ(driven(more)["outcome"], "solved");
    long count = 0;  // a rim, not quite opaque: bluish dark
    for (const Colour& colour : read_png(file("route.png")).pixels)
      count += colour.blue > 100 && colour.blue > colour.red + 60 && colour.red < 90 ? 1 : 0;
    return count;
  };
  const long of_point = robot_pixels({"--radius-m", "0"});
  const long of_disc = robot_pixels({"--radius-m", "0.3"});
  const long of_car =
      robot_pixels({"--robot", robot("small_car"), "--set", "footprint=robot", "--set", "kinematics=reeds_shepp"});
  EXPECT_GT(of_disc, of_point + 200);
  EXPECT_GT(of_car, of_point + 200);
}

}  // namespace
}  // namespace cairn::testing_program
