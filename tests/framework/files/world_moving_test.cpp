#include "framework/files/world_moving.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/files/world_file.hpp"
#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

using config_test::error_of;
using config_test::TestFolder;
using testing::HasSubstr;

const std::string kBounds = "bounds_m: [[0, 0], [6, 5]]\n";

World load_text(const std::string& text) {
  const TestFolder folder;
  return load_world(folder.write("w.yaml", kBounds + text), {});
}

std::string error_in(const std::string& text) {
  const TestFolder folder;
  const auto file = folder.write("w.yaml", kBounds + text);
  return folder.without_folder(error_of([&] { (void)load_world(file, {}); }));
}

std::string error_in_door(const std::string& settings) {
  return error_in("doors:\n  - {from_m: [1, 1], to_m: [2, 1], " + settings + "}\n");
}

std::string error_in_mover(const std::string& settings) {
  return error_in("movers:\n  - {circle_diameter_m: 0.4, " + settings + "}\n");
}

TEST(WorldMoving, ADoorIsClosedAtItsTimes) {
  const World world = load_text(
      "doors:\n"
      "  - {name: lab, from_m: [1, 1], to_m: [2, 1], closed_s: [[10, 20], [20, 25]], surface: rough}\n"
      "  - {from_m: [3, 1], to_m: [3, 2], closes: {every_s: 60, for_s: 20, first_s: 5}}\n"
      "  - {from_m: [4, 1], to_m: [4, 2], closed_s: []}\n");
  ASSERT_EQ(world.doors.size(), 3U);
  EXPECT_EQ(world.doors[0].name, "lab");
  EXPECT_EQ(world.doors[0].surface, Surface::rough);
  EXPECT_EQ(world.doors[1].surface, Surface::smooth);
  for (const double time_s : {10.0, 20.0, 24.9}) EXPECT_TRUE(world.doors[0].closes_at(time_s)) << time_s;
  for (const double time_s : {0.0, 9.9, 25.0}) EXPECT_FALSE(world.doors[0].closes_at(time_s)) << time_s;
  for (const double time_s : {5.0, 24.9, 65.0}) EXPECT_TRUE(world.doors[1].closes_at(time_s)) << time_s;
  for (const double time_s : {0.0, 4.9, 25.0, 64.9}) EXPECT_FALSE(world.doors[1].closes_at(time_s)) << time_s;
  EXPECT_FALSE(world.doors[2].closes_at(0.0));
}

TEST(WorldMoving, AMoverIsWhatItsFileSays) {
  const World world = load_text(
      "movers:\n"
      "  - {name: cart, polygon_m: [[10, 10], [12, 10], [12, 11], [10, 11]], path_m: [[1, 1], [5, 1], [5, 4]],\n"
      "     speed_mps: 0.8, pause_s: 3, course: round, start_s: 7, surface: smooth, waits: false}\n"
      "  - {circle_diameter_m: 0.4, path_m: [[1, 1], [5, 1]], keeps_m: 0.5}\n");
  ASSERT_EQ(world.movers.size(), 2U);
  const WorldMover& cart = world.movers[0];
  EXPECT_EQ(cart.name, "cart");
  EXPECT_EQ(cart.contour.polygons_m[0][0], Point(-1, -0.5)) << "about its centroid";
  EXPECT_EQ(cart.path_m[2], Point(5, 4));
  EXPECT_EQ(cart.speed_mps, 0.8);
  EXPECT_EQ(cart.pause_s, 3.0);
  EXPECT_EQ(cart.course, Course::round);
  EXPECT_EQ(cart.start_s, 7.0);
  EXPECT_EQ(cart.surface, Surface::smooth);
  EXPECT_FALSE(cart.waits);
  EXPECT_TRUE(world.movers[1].waits);
  EXPECT_EQ(world.movers[1].keeps_m, 0.5);
  EXPECT_EQ(world.movers[1].course, Course::there_and_back);
}

TEST(WorldMoving, SaysWhatIsWrongWithADoor) {
  EXPECT_EQ(error_in("doors: [{from_m: [1, 1], to_m: [1, 1], closed_s: []}]"),
            "w.yaml:2:32: a door needs a length: from_m and to_m are the same place");
  EXPECT_EQ(error_in("doors: [{from_m: [1, 1], to_m: [9, 1], closed_s: []}]"),
            "w.yaml:2:32: to_m [9, 1] lies outside bounds_m [0, 0] to [6, 5]");
  EXPECT_EQ(error_in("doors: [{from_m: [1, 1], to_m: [2, 1]}]"), "w.yaml:2:9: a door needs one of closed_s, closes");
  EXPECT_EQ(error_in_door("closed_s: [[5, 9], [8, 10]]"),
            "w.yaml:3:55: a door's times closed must follow each other: [8, 10] begins before [5, 9] ends");
  EXPECT_EQ(error_in_door("closed_s: [[9, 5]]"),
            "w.yaml:3:47: a door's time closed must end after it begins, found [9, 5]");
  EXPECT_EQ(error_in_door("closed_s: [[9]]"),
            "w.yaml:3:47: each item of closed_s must be two times [begin, end], found a list of 1");
  EXPECT_THAT(error_in_door("closed_s: [[-1, 5]]"), HasSubstr("w.yaml:3:48: each item of closed_s must be a number"));
  EXPECT_THAT(error_in_door("closed_s: 5"), HasSubstr("w.yaml:3:46: closed_s must be a list"));
  EXPECT_EQ(error_in_door("closes: {every_s: 5, for_s: 5}"),
            "w.yaml:3:44: a door that closes every 5 s must be closed for less than that, found 5 s");
  EXPECT_THAT(error_in_door("closd_s: []"), HasSubstr("(did you mean \"closed_s\"?)"));
}

TEST(WorldMoving, SaysWhatIsWrongWithAMover) {
  EXPECT_EQ(error_in_mover("path_m: [[1, 1]]"), "w.yaml:3:38: a path needs at least 2 points, found 1");
  EXPECT_EQ(error_in_mover("path_m: [[1, 1], [1, 1]]"), "w.yaml:3:47: a path's point stands here twice: [1, 1]");
  EXPECT_EQ(error_in_mover("path_m: [[1, 1], [7, 1]]"),
            "w.yaml:3:47: the path's point [7, 1] lies outside bounds_m [0, 0] to [6, 5]");
  EXPECT_THAT(error_in_mover("path_m: [[1, 1], [2, 1], [1, 1]], course: round"),
              HasSubstr("w.yaml:3:55: a round goes back"));
  EXPECT_EQ(error_in_mover("path_m: [[1, 1], [2, 1]], speed_mps: 0"),
            "w.yaml:3:67: speed_mps must be a number from 0.01 to 10 m/s, found \"0\"");
  EXPECT_THAT(error_in_mover("path_m: [[1, 1], [2, 1]], speed_mps: -1"), HasSubstr("found \"-1\""));
  EXPECT_THAT(error_in_mover("path_m: [[1, 1], [2, 1]], course: raund"), HasSubstr("(did you mean \"round\"?)"));
  EXPECT_THAT(error_in_mover("path_m: [[1, 1], [2, 1]], waits: false, keeps_m: 1"),
              HasSubstr("keeps_m goes with waits: true"));
  EXPECT_THAT(error_in("movers: [{path_m: [[1, 1], [2, 1]]}]"),
              HasSubstr("a mover needs one of circle_diameter_m, polygon_m"));
  EXPECT_THAT(error_in("movers: [{path_m: [[1, 1], [2, 1]], polygon_m: [[0, 0], [1, 1]]}]"),
              HasSubstr("w.yaml:2:48: polygon_m: "));
}

TEST(WorldMoving, TwoOfANameAreNotDistinguished) {
  EXPECT_EQ(error_in("doors: [{name: ann, from_m: [1, 1], to_m: [2, 1], closed_s: []}]\n"
                     "movers: [{name: ann, circle_diameter_m: 0.4, path_m: [[1, 1], [2, 1]]}]\n"),
            "w.yaml:3:17: two doors or movers are called \"ann\"");
}

}  // namespace
}  // namespace cairn
