#include "framework/reporting/near_misses.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

Matching matching(const Point& at_m, double square, double circle) {
  Matching matching;
  matching.degrees = {{"circle", circle, 0.0, at_m, circle > 0.6}, {"square", square, 0.0, at_m, square > 0.6}};
  matching.fits_above = 0.6;
  return matching;
}

TEST(NearMisses, NameBothCategoriesAndWhatIsNeeded) {
  NearMisses misses;
  misses.update(matching({1.0, 2.0}, 0.57, 0.52), 7.5);
  const std::vector<NearMiss> found = misses.away_from({});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(words_about(found[0]), "square 0.57 (circle 0.52), needs 0.60");
  EXPECT_EQ(found[0].at_m, Point(1.0, 2.0));
}

TEST(NearMisses, LeaveOutWhatHardlyFits) {
  NearMisses misses;
  misses.update(matching({1.0, 2.0}, 0.44, 0.2), 7.5);
  EXPECT_TRUE(misses.away_from({}).empty());
}

TEST(NearMisses, KeepTheNewestOfAPlaceAndListTheBestFirst) {
  NearMisses misses;
  misses.update(matching({1.0, 2.0}, 0.59, 0.5), 7.5);
  misses.update(matching({1.1, 2.1}, 0.5, 0.47), 7.5);
  misses.update(matching({4.0, 2.0}, 0.3, 0.55), 7.5);
  const std::vector<NearMiss> found = misses.away_from({});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].category, "circle");
  EXPECT_EQ(found[1].degree, 0.5);
}

TEST(NearMisses, EndWhereALandmarkIsFound) {
  NearMisses misses;
  misses.update(matching({1.0, 2.0}, 0.59, 0.5), 7.5);
  misses.update(matching({4.0, 2.0}, 0.59, 0.5), 7.5);
  Matching decided = matching({1.0, 2.1}, 0.7, 0.5);
  decided.detection = Detection{"square", {1.0, 2.1, 0.0}, 0.7, {}};
  misses.update(decided, 7.5);
  EXPECT_EQ(misses.away_from({}).size(), 1U);
  LandmarkGraph graph;
  Landmark landmark;
  landmark.category = "square";
  landmark.T_map_landmark = {4.1, 2.0, 0.0};
  graph.add(landmark);
  EXPECT_TRUE(misses.away_from(graph).empty());
}

TEST(NearMisses, KeepTheBestWhereThereAreTooMany) {
  NearMisses misses;
  for (int i = 0; i < 300; ++i) misses.update(matching({1.0 * i, 0.0}, i == 0 ? 0.46 : 0.5, 0.1), 7.5);
  EXPECT_EQ(misses.away_from({}).size(), NearMisses::kMaxPlaces);
  EXPECT_EQ(misses.away_from({}).back().degree, 0.5);
}

TEST(NearMisses, AreCloseFromHalfOfTheWayToWhatIsNeeded) {
  NearMiss miss{"square", {0.0, 0.0}, 0.52};
  EXPECT_TRUE(miss.is_close()) << "of a detector without a threshold nobody can tell";
  miss.needed = 0.6;
  EXPECT_FALSE(miss.is_close());
  miss.degree = 0.53;
  EXPECT_TRUE(miss.is_close());
}

}  // namespace
}  // namespace cairn
