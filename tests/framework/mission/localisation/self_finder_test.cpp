#include "framework/mission/localisation/self_finder.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// A room of 4 x 3 m.
OccupancyGrid room() {
  OccupancyGrid grid(0.05);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x)
      grid.set_log_odds({x, y}, log_odds_of(x == 0 || y == 0 || x == 79 || y == 59 ? 0.95 : 0.05));
  return grid;
}

// Drives until a search is under way.
void begin_search(SelfFinder& finder, const OccupancyGrid& seen) {
  for (double x_m = 1.0; x_m <= 2.5; x_m += 0.05) finder.update({}, {x_m, 1.5, 0.0}, seen, x_m);
}

TEST(SelfFinder, ASearchThatNobodyNeedsAnyMoreOutlivesTheFinder) {
  auto map = std::make_shared<const OccupancyGrid>(room());
  const std::weak_ptr<const OccupancyGrid> searched = map;
  std::optional<SelfFinder> finder(std::in_place, std::move(map), RobotModel{});
  begin_search(*finder, room());
  EndingSearches ending;
  ending.add(finder->let_go());
  EXPECT_EQ(finder->let_go(), nullptr) << "there is none any more";
  finder.reset();
  EXPECT_FALSE(searched.expired()) << "the search has its map";
  ending.wait();
  EXPECT_TRUE(searched.expired());
}

TEST(SelfFinder, ASearchThatHasEndedIsDroppedWithTheNextOne) {
  auto map = std::make_shared<const OccupancyGrid>(room());
  const std::weak_ptr<const OccupancyGrid> searched = map;
  std::optional<SelfFinder> finder(std::in_place, std::move(map), RobotModel{});
  begin_search(*finder, room());
  EndingSearches ending;
  ending.add(finder->let_go());
  finder.reset();
  EXPECT_FALSE(searched.expired());
  const auto at_most = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!searched.expired() && std::chrono::steady_clock::now() < at_most) ending.add(nullptr);
  EXPECT_TRUE(searched.expired());
}

TEST(SelfFinder, AnswersAreThoseOfSearchesThatItHasNotLetGo) {
  SelfFinder finder(std::make_shared<const OccupancyGrid>(room()), RobotModel{});
  begin_search(finder, room());
  EndingSearches ending;
  ending.add(finder.let_go());
  finder.update({}, {2.5, 1.5, 0.0}, room(), 100.0);
  EXPECT_EQ(finder.figures().searches, 0);
}

TEST(SelfFinder, LetsNothingGoBeforeTheFirstSearch) {
  SelfFinder finder(std::make_shared<const OccupancyGrid>(room()), RobotModel{});
  EXPECT_EQ(finder.let_go(), nullptr);
}

}  // namespace
}  // namespace cairn
