// Merging, cropping and comparing saved maps, as a user sees them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scenario/maps/map_files.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class MapEdit : public MapFiles {
 protected:
  MapEdit() : MapFiles("map_edit") {}
  void SetUp() override {
    save("a.cairn", drawn_map({"####", "#..#", "#..?"}, {0.0, 0.0}));
    save("b.cairn", drawn_map({"..##", "...#"}, {0.0, 0.0}));
  }
};

TEST_F(MapEdit, MergeLaysTheSecondMapIntoTheFrameOfTheFirst) {
  const json reported =
      done({"merge", file("a.cairn"), file("b.cairn"), "--transform", "0.2, 0.05,0", "-o", file("m.cairn")});
  EXPECT_EQ(reported["size_cells"], (json{8, 3}));
  EXPECT_EQ(reported["joined_landmarks"], 1);
  EXPECT_EQ(reported["landmarks"], 1);
  const SavedMap merged = map("m.cairn");
  EXPECT_EQ(merged.grid.state({4, 1}), CellState::free);
  EXPECT_EQ(merged.grid.state({7, 2}), CellState::occupied);
  EXPECT_EQ(merged.grid.state({3, 0}), CellState::unknown);
  EXPECT_EQ(merged.properties.at("merged_from"), "b.cairn at 0.2, 0.05,0");
  EXPECT_EQ(done({"merge", file("a.cairn"), file("b.cairn"), "--transform", "9,0,90", "--near-m", "0.1", "-o",
                  file("m.cairn")})["landmarks"],
            2);
}

// An L-shaped room with a corner in it, as one sees it whose frame is turned by a right angle for `turned`.
SavedMap room(int from_x, int to_x, bool turned) {
  SavedMap map;
  map.grid = OccupancyGrid(0.05);
  for (int y = 0; y < 80; ++y)
    for (int x = from_x; x < to_x; ++x) {
      const bool is_out = x >= 80 && y >= 40;
      const bool is_wall = x < 2 || x >= 138 || y < 2 || y >= 78 || (x >= 78 && y >= 38) ||
                           (x >= 30 && x < 34 && y >= 50) || (x >= 100 && x < 103 && y < 20);
      if (is_out && !(x < 82 || y < 42)) continue;
      map.grid.set_log_odds(turned ? Cell{-y, x} : Cell{x, y}, is_wall ? LogOdds{900} : LogOdds{-900});
    }
  return map;
}

TEST_F(MapEdit, MergeFindsOutWhereTheSecondMapLiesAndCountsNothingTwice) {
  save("west.cairn", room(0, 110, false));
  save("east.cairn", room(20, 140, true));
  const json found = done({"merge", file("west.cairn"), file("east.cairn"), "-o", file("m.cairn")});
  EXPECT_NEAR(found["transform"]["deg"].get<double>(), -90.0, 1.0) << found;
  EXPECT_GT(found["transform"]["wall_ratio"], 0.95);
  const SavedMap merged = map("m.cairn");
  EXPECT_EQ(merged.grid.state(merged.grid.cell_at({6.0, 1.0})), CellState::free);

  const json again = done({"merge", file("m.cairn"), file("east.cairn"), "-o", file("again.cairn")});
  EXPECT_TRUE(again["transform"].is_null());
  EXPECT_EQ(map("again.cairn").grid.log_odds(merged.grid.cell_at({3.0, 1.0})),
            merged.grid.log_odds(merged.grid.cell_at({3.0, 1.0})));
  save("other.cairn", drawn_map({"..##", "...#"}, {0.0, 0.0}));
  done({"merge", file("m.cairn"), file("other.cairn"), "--transform", "0,0,0", "-o", file("more.cairn")});
  EXPECT_THAT(refused({"merge", file("m.cairn"), file("more.cairn"), "--transform", "0,0,0", "-o", file("x.cairn")}),
              HasSubstr("both hold the evidence of one map"));
}

TEST_F(MapEdit, MergeSaysWhyItCannotFindOut) {
  save("west.cairn", room(0, 110, false));
  const Finished tried =
      run_cairn({"map", "merge", file("west.cairn"), file("b.cairn"), "-o", file("m.cairn"), "--json"});
  EXPECT_EQ(tried.exit_status, 1);
  EXPECT_NE(json::parse(tried.out)["reason"], "");
  EXPECT_THAT(tried.err, HasSubstr("do not show where one lies in the other: "));
  EXPECT_FALSE(std::filesystem::exists(file("m.cairn")));
}

TEST_F(MapEdit, NoInputIsOverwrittenUnlessOutNamesIt) {
  const std::string a = text_of_file(file("a.cairn"));
  const std::string b = text_of_file(file("b.cairn"));
  done({"merge", file("a.cairn"), file("b.cairn"), "--transform", "1,0,0", "-o", file("m.cairn")});
  done({"crop", file("a.cairn"), "--box", "0,0,0.1,0.1", "-o", file("c.cairn")});
  done({"diff", file("a.cairn"), file("b.cairn"), "--picture", file("d.png")}, 1);
  EXPECT_EQ(text_of_file(file("a.cairn")), a);
  EXPECT_EQ(text_of_file(file("b.cairn")), b);
  done({"crop", file("a.cairn"), "--box", "0,0,0.1,0.1", "-o", file("a.cairn")});
  EXPECT_EQ(map("a.cairn").grid.bounds(), (CellBox{{0, 0}, {2, 2}}));
}

TEST_F(MapEdit, RoutesAreClosedAndOpened) {
  SavedMap two = map("a.cairn");
  Landmark other = two.graph.landmarks().begin()->second;
  other.id = 2;
  other.T_map_landmark.x_m += 0.1;
  two.graph.add(other);
  two.graph.add_route({3, 1, 2, 5.0, {}, false, false, 0});
  two.graph.add_route({4, 2, 1, 5.0, {}, false, false, 0});
  save("two.cairn", two);
  const auto closed = [&] {
    const SavedMap now = map("two.cairn");
    return std::pair(now.graph.find_route(3)->closed, now.graph.find_route(4)->closed);
  };
  EXPECT_EQ(done({"close", file("two.cairn"), "R4"})["changed"], (json{4}));
  EXPECT_EQ(closed(), std::pair(false, true));
  EXPECT_EQ(done({"close", file("two.cairn"), "4", "R3", "3"})["changed"], (json{3}));
  EXPECT_EQ(done({"open", file("two.cairn"), "R3", "--both-ways"})["changed"], (json{3, 4}));
  EXPECT_EQ(closed(), std::pair(false, false));
  EXPECT_EQ(refused({"close", file("two.cairn"), "R9"}), "cairn: the map has no route 9\n");
  EXPECT_EQ(refused({"close", file("two.cairn"), "L1"}),
            "cairn: route \"L1\": a route is named by its number, as 12 or R12\n");
}

TEST_F(MapEdit, CropReportsWhatItDrops) {
  const json reported = done({"crop", file("a.cairn"), "--box", "0.05,0,0.0,0.05", "-o", file("c.cairn")});
  EXPECT_EQ(reported["size_cells"], (json{1, 1}));
  EXPECT_EQ(reported["landmarks_dropped"], 1);
  EXPECT_EQ(reported["warnings"], (json{"1 landmark outside: dropped"}));
}

TEST_F(MapEdit, DiffSaysSameOrDifferentByItsExitStatus) {
  EXPECT_EQ(done({"diff", file("a.cairn"), file("a.cairn")})["outcome"], "same");
  const json reported = done({"diff", file("a.cairn"), file("b.cairn"), "--picture", file("d.png")}, 1);
  EXPECT_EQ(reported["outcome"], "different");
  // One row of b lies on a's lowest but unknown, one above.
  EXPECT_EQ(reported["cells"]["free_to_occupied"], 1);
  EXPECT_EQ(reported["cells"]["occupied_to_free"], 2);
  EXPECT_EQ(reported["cells"]["occupied_to_unknown"], 4);
  EXPECT_EQ(reported["cells"]["unknown_to_occupied"], 1);
  EXPECT_EQ(reported["cells"]["other_state"], 8);
  EXPECT_EQ(reported["landmarks"]["moved"][0]["b"]["id"], "L1");
  EXPECT_EQ(text_of_file(file("d.png")).substr(1, 3), "PNG");
}

TEST_F(MapEdit, BadTransformsAndBoxesAreRefused) {
  for (const char* const text : {"nan,0,0", "1,2", "1,2,3,4", "a,0,0", "", "1,,2", "inf,0,0", "1e9,0,0"})
    EXPECT_EQ(refused({"merge", file("a.cairn"), file("b.cairn"), "--transform", text, "-o", file("m.cairn")}),
              "cairn: map merge: --transform must be x,y,deg, finite numbers within +-1e+06 with commas between them, "
              "found \"" +
                  std::string(text) + "\"\n");
  for (const char* const text : {"0,0,nan,1", "0,0,1", "x"})
    EXPECT_THAT(refused({"crop", file("a.cairn"), "--box", text, "-o", file("m.cairn")}),
                HasSubstr("map crop: --box must be x0,y0,x1,y1"));
  EXPECT_EQ(
      refused({"crop", file("a.cairn"), "--box", "5,5,6,6", "-o", file("m.cairn")}),
      "cairn: map crop: " + file("a.cairn") +
          ": nothing of the map lies in the box 5,5 to 6,6; the map reaches from 0,0 to 0.2,0.15000000000000002\n");
  EXPECT_THAT(refused({"crop", file("a.cairn"), "--box", "0,0,0,1", "-o", file("m.cairn")}),
              HasSubstr("some width and height"));
  EXPECT_THAT(refused({"merge", file("a.cairn"), file("b.cairn"), "--transform", "900000,0,0", "-o", file("m.cairn")}),
              HasSubstr("are too many"));
  EXPECT_FALSE(std::filesystem::exists(file("m.cairn")));
}

TEST_F(MapEdit, FilesThatAreNoMapsAreRefused) {
  write_text(file("text.cairn"), "no map");
  for (const char* const name : {"none.cairn", "text.cairn"}) {
    EXPECT_THAT(refused({"merge", file("a.cairn"), file(name), "--transform", "0,0,0", "-o", file("m.cairn")}),
                HasSubstr(name));
    EXPECT_THAT(refused({"crop", file(name), "--box", "0,0,1,1", "-o", file("m.cairn")}), HasSubstr(name));
    EXPECT_THAT(refused({"diff", file(name), file("a.cairn")}), HasSubstr(name));
  }
  EXPECT_EQ(refused({"merge", file("a.cairn"), file("a.cairn"), "--transform", "1,0,0", "-o", file("m.cairn")}),
            "cairn: map merge: " + file("a.cairn") + " and " + file("a.cairn") +
                " are the same file, whose evidence would count twice\n");
  EXPECT_THAT(refused({"diff", file("a.cairn"), file("b.cairn"), "--picture", "d.jpg"}), HasSubstr("known are .png"));
  EXPECT_FALSE(std::filesystem::exists(file("m.cairn")));
}

TEST_F(MapEdit, CellsOfAnotherSizeAreRefused) {
  SavedMap other = map("b.cairn");
  other.grid = OccupancyGrid(0.1);
  other.grid.set_log_odds({0, 0}, 9);
  save("other.cairn", other);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"merge", "--transform", "0,0,0", "-o", file("m.cairn")}, {"diff"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.begin() + 1, {file("a.cairn"), file("other.cairn")});
    EXPECT_THAT(refused(arguments), HasSubstr("cells of different size, 0.05 m and 0.1 m"));
  }
}

}  // namespace
}  // namespace cairn::testing_program
