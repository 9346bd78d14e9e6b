#include "maps/edit/alignment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using testing::HasSubstr;

struct Wall {
  Point from_m;
  Point to_m;
};

// Two rooms that are not alike, and a corridor below them.
const std::vector<Wall> kFlat = {{{0, 0}, {12, 0}}, {{12, 0}, {12, 7}}, {{12, 7}, {0, 7}},  {{0, 7}, {0, 0}},
                                 {{0, 2}, {2, 2}},  {{3, 2}, {9, 2}},   {{10, 2}, {12, 2}}, {{5, 2}, {5, 7}},
                                 {{1, 5}, {2, 5}},  {{2, 5}, {2, 6}},   {{7, 4}, {8.5, 4}}, {{8.5, 4}, {8.5, 5}},
                                 {{10, 6}, {12, 6}}};

// The part of the flat between two corners, as somebody has it whose frame lies at T_flat_map.
SavedMap part_of_flat(const std::vector<Wall>& walls, const Point& low_m, const Point& high_m,
                      const Pose2& T_flat_map) {
  SavedMap map;
  map.grid = OccupancyGrid(0.05);
  const Pose2 T_map_flat = inverse(T_flat_map);
  const auto draw = [&](double step_m, const Point& from_m, const Point& to_m, LogOdds value) {
    const int steps = std::max(1, static_cast<int>((to_m - from_m).norm() / step_m));
    for (int i = 0; i <= steps; ++i) {
      const Point at_m = from_m + (to_m - from_m) * (static_cast<double>(i) / steps);
      if ((at_m.array() < low_m.array()).any() || (at_m.array() > high_m.array()).any()) continue;
      map.grid.set_log_odds(map.grid.cell_at(T_map_flat * at_m), value);
    }
  };
  for (double y_m = 0.0; y_m <= 7.0; y_m += 0.02) draw(0.02, {0.0, y_m}, {12.0, y_m}, LogOdds{-900});
  for (const Wall& wall : walls) draw(0.02, wall.from_m, wall.to_m, LogOdds{900});
  return map;
}

void add_landmark(SavedMap& map, const Pose2& T_flat_map, const std::string& category, const Point& at_m) {
  Landmark landmark;
  landmark.category = category;
  const Point there_m = inverse(T_flat_map) * at_m;
  landmark.T_map_landmark = {there_m.x(), there_m.y(), 0.0};
  map.graph.add(landmark);
}

void expect_near(const Pose2& found, const Pose2& truth) {
  EXPECT_LT((found.position() - truth.position()).norm(), 0.08);
  EXPECT_LT(std::abs(wrap_angle(found.theta_rad - truth.theta_rad)), radians(1.0));
}

TEST(AlignMaps, FindsWhereTheyLieByWhatTheirGridsShare) {
  const Pose2 T_flat_b{3.0, -1.0, radians(100.0)};
  const SavedMap a = part_of_flat(kFlat, {0, 0}, {8, 7}, {});
  const SavedMap b = part_of_flat(kFlat, {2, 0}, {12, 7}, T_flat_b);
  const AlignmentResult result = align_maps(a, b);
  ASSERT_TRUE(result.alignment) << result.reason;
  expect_near(result.alignment->T_a_b, T_flat_b);
  EXPECT_GT(result.alignment->wall_ratio, 0.9);
  EXPECT_LT(result.alignment->contradicted_ratio, 0.02);
}

TEST(AlignMaps, LandmarksTellWhatBareWallsCannot) {
  const std::vector<Wall> hall = {{{0, 0}, {12, 0}}, {{12, 0}, {12, 7}}, {{12, 7}, {0, 7}}, {{0, 7}, {0, 0}}};
  const Pose2 T_flat_b{6.0, 3.5, radians(170.0)};
  SavedMap a = part_of_flat(hall, {0, 0}, {12, 7}, {});
  SavedMap b = part_of_flat(hall, {0, 0}, {12, 7}, T_flat_b);
  EXPECT_THAT(align_maps(a, b).reason, HasSubstr("nearly as well")) << "a hall looks the same turned by 180 degrees";
  for (const Point& at_m : {Point(2, 2), Point(5, 4), Point(9, 3)}) {
    add_landmark(a, {}, "square", at_m);
    add_landmark(b, T_flat_b, "square", at_m);
  }
  const AlignmentResult result = align_maps(a, b);
  ASSERT_TRUE(result.alignment) << result.reason;
  EXPECT_EQ(result.alignment->landmarks, 3U);
  expect_near(result.alignment->T_a_b, T_flat_b);
}

TEST(AlignMaps, OtherPlacesAreNotLaidOnEachOther) {
  const std::vector<Wall> other = {{{0, 0}, {9, 0}}, {{9, 0}, {9, 3}}, {{9, 3}, {4, 6}}, {{4, 6}, {0, 7}},
                                   {{0, 7}, {0, 0}}, {{3, 1}, {4, 2}}, {{6, 1}, {6, 2}}};
  const SavedMap a = part_of_flat(kFlat, {0, 0}, {12, 7}, {});
  const SavedMap b = part_of_flat(other, {0, 0}, {9, 7}, {});
  const AlignmentResult result = align_maps(a, b);
  EXPECT_FALSE(result.alignment);
  EXPECT_NE(result.reason, "");
}

TEST(AlignMaps, PartsThatShareNothingAreNotLaidOnEachOther) {
  const SavedMap a = part_of_flat(kFlat, {0, 0}, {4.5, 7}, {});
  const SavedMap b = part_of_flat(kFlat, {5.5, 0}, {12, 7}, {1.0, 1.0, 0.3});
  EXPECT_FALSE(align_maps(a, b).alignment);
}

TEST(AlignMaps, NeedsCellsOfOneSize) {
  const SavedMap a = part_of_flat(kFlat, {0, 0}, {4.5, 7}, {});
  SavedMap b;
  b.grid = OccupancyGrid(0.1);
  EXPECT_FALSE(align_maps(a, b).alignment);
  b.grid.set_log_odds({0, 0}, LogOdds{900});
  EXPECT_THROW((void)align_maps(a, b), std::invalid_argument);
}

}  // namespace
}  // namespace cairn
