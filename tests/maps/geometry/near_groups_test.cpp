#include "maps/geometry/near_groups.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Joins whatever is near, over and over, until nothing changes.
std::vector<std::vector<std::size_t>> groups_by_brute_force(const std::vector<ThingAt>& things, double within_m) {
  std::vector<std::size_t> group(things.size());
  for (std::size_t i = 0; i < things.size(); ++i) group[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < things.size(); ++i)
      for (std::size_t k = 0; k < things.size(); ++k)
        if (things[i].sort == things[k].sort && (things[i].at_m - things[k].at_m).norm() <= within_m &&
            group[k] < group[i]) {
          group[i] = group[k];
          changed = true;
        }
  }
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t first = 0; first < things.size(); ++first) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < things.size(); ++i)
      if (group[i] == first) members.push_back(i);
    if (members.size() > 1) groups.push_back(members);
  }
  return groups;
}

TEST(NearGroups, AreChainsOfWhatIsNear) {
  const std::vector<ThingAt> things{{{0, 0}, 1}, {{0.9, 0}, 1}, {{1.8, 0}, 1}, {{3.0, 0}, 1}, {{0, 0}, 2}};
  EXPECT_THAT(near_groups(things, 1.0), ElementsAre(ElementsAre(0, 1, 2)));
  EXPECT_THAT(near_groups({}, 1.0), IsEmpty());
}

TEST(NearGroups, AgreeWithBruteForceOnRandomPlaces) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<ThingAt> things(1 + random() % 60);
    for (ThingAt& thing : things) thing = {{3.0 * unit(random), 3.0 * unit(random)}, random() % 2};
    const double within_m = 0.05 + 0.5 * std::abs(unit(random));
    EXPECT_EQ(near_groups(things, within_m), groups_by_brute_force(things, within_m)) << "trial " << trial;
  }
}

TEST(NearGroups, AThousandAtOnePlaceAndPlacesBeyondAllMaps) {
  std::vector<ThingAt> things(1000);
  things.push_back({{1e300, -1e300}, 0});
  things.push_back({{-1e300, 1e300}, 0});
  const auto groups = near_groups(things, 1e-3);
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].size(), 1000U);
}

}  // namespace
}  // namespace cairn
