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

// A finder whose search under way nobody needs any more.
class LetGo : public testing::Test {
 protected:
  LetGo() {
    auto map = std::make_shared<const OccupancyGrid>(room());
    searched_ = map;
    finder_.emplace(std::move(map), RobotModel{});
    begin_search(*finder_, room());
    ending_.add(finder_->let_go());
  }
  std::weak_ptr<const OccupancyGrid> searched_;
  std::optional<SelfFinder> finder_;
  EndingSearches ending_;
};

TEST_F(LetGo, ASearchThatNobodyNeedsAnyMoreOutlivesTheFinder) {
  EXPECT_EQ(finder_->let_go(), nullptr) << "there is none any more";
  finder_.reset();
  EXPECT_FALSE(searched_.expired()) << "the search has its map";
  ending_.wait();
  EXPECT_TRUE(searched_.expired());
}

TEST_F(LetGo, ASearchThatHasEndedIsDroppedWithTheNextOne) {
  finder_.reset();
  EXPECT_FALSE(searched_.expired());
  const auto at_most = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!searched_.expired() && std::chrono::steady_clock::now() < at_most) ending_.add(nullptr);
  EXPECT_TRUE(searched_.expired());
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
