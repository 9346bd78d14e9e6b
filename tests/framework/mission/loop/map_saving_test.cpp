#include "framework/mission/loop/map_saving.hpp"

#include <gmock/gmock.h>

#include "tests/framework/mission/loop/host_fixture.hpp"

namespace cairn {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class MapSavingTest : public HostFixture {
 protected:
  // Ticks until the autosave that was begun is reported.
  void autosave_and_wait() {
    const std::size_t before = events_.names.size();
    do {
      saving().autosave();
      std::this_thread::yield();
    } while (events_.names.size() == before);
  }
};

TEST_F(MapSavingTest, AMapThatAStepSavesIsPublishedAndLoadsAgain) {
  EXPECT_EQ(saving().save("a.cairn").reason, "saved a.cairn");
  EXPECT_THAT(events_.names, ElementsAre("saved a.cairn"));
  EXPECT_EQ(saving().map_file(), "a.cairn");
  EXPECT_GT(saving().explored_ratio(), 0.0);
  EXPECT_EQ(load_map(folder_ / "a.cairn").grid, grid_);
}

TEST_F(MapSavingTest, SubmapsThatCannotBeTrueDoNotCostTheMap) {
  submaps_.nodes = {{0, 0.0, {1.0, 2.0, 0.0}}};
  EXPECT_EQ(saving().save("a.cairn").reason, "saved a.cairn");
  EXPECT_EQ(load_map(folder_ / "a.cairn").submaps, submaps_);
  EXPECT_EQ(saving().pose_graph(), counts_of(submaps_));
  submaps_.edges = {{0, 7, {}}};
  EXPECT_EQ(saving().save("a.cairn").reason, "saved a.cairn");
  EXPECT_TRUE(load_map(folder_ / "a.cairn").submaps.empty());
  EXPECT_FALSE(saving().pose_graph());
  EXPECT_THAT(events_.names, Contains(HasSubstr("without its submaps: the edge from 0 to 7 lacks an end")));
}

TEST_F(MapSavingTest, AStepThatCouldNotSaveIsRememberedToTheEnd) {
  EXPECT_THAT(saving().save("nowhere/a.cairn").reason, StartsWith("the map could not be saved: "));
  EXPECT_THAT(saving().save_last(true), StartsWith("the map could not be saved: "));
  EXPECT_EQ(saving().map_file(), "still.cairn") << "the last one is saved all the same";
}

TEST_F(MapSavingTest, WithoutAGridThereIsNothingToSave) {
  world_.grid = nullptr;
  EXPECT_EQ(saving().save_last(true), "there is no map to save");
  EXPECT_EQ(saving().map_file(), "");
}

TEST_F(MapSavingTest, AutosavesWhenItsIntervalIsOverByTheWallClock) {
  autosaves_ = true;
  mission_.config.autosave.every_s = 30.0;
  autosave_and_wait();
  EXPECT_THAT(events_.names, ElementsAre("autosaved still.autosave.cairn"));
  time_->advance(std::chrono::seconds(14));
  saving().autosave();
  EXPECT_EQ(saving().figures().saved, 1) << "not before half of it";
  time_->advance(std::chrono::seconds(16));
  autosave_and_wait();
  EXPECT_EQ(saving().figures().saved, 2);
  EXPECT_EQ(saving().save_last(true), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "still.autosave.cairn")) << "a whole map has taken its place";
}

TEST_F(MapSavingTest, WhenTheLastMapCannotBeSavedTheAutosaveStaysAndIsNamed) {
  autosaves_ = true;
  mission_.config.autosave.every_s = 30.0;
  progress_.time_s = 12.4;
  autosave_and_wait();
  std::filesystem::create_directories(folder_ / "still.cairn");
  EXPECT_THAT(saving().save_last(true), HasSubstr("; still.autosave.cairn holds it up to 12 s"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "still.autosave.cairn"));
}

TEST_F(MapSavingTest, AnAutosaveThatFailsIsPublishedOnce) {
  autosaves_ = true;
  mission_.config.autosave.every_s = 1.0;
  std::filesystem::create_directories(folder_ / "still.autosave.cairn");
  autosave_and_wait();
  while (saving().figures().failed < 3) {
    time_->advance(std::chrono::seconds(2));
    saving().autosave();
    std::this_thread::yield();
  }
  EXPECT_EQ(saving().save_last(true), "");
  EXPECT_EQ(std::ranges::count(events_.names, "autosave failed"), 1);
}

// Finished: no step is under way.
TEST_F(MapSavingTest, TheMapOfAnEarlierMissionThatEndedIsKeptWhenThisOneDidNot) {
  EXPECT_EQ(saving().save_last(true), "");
  saving_ = nullptr;
  EXPECT_EQ(saving().save_last(false), "");
  EXPECT_THAT(events_.names, Contains("this mission did not end: the map of an earlier one that did is kept as "
                                      "still.1.cairn"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "still.1.cairn"));
}

TEST_F(MapSavingTest, AMissionThatGoesOnReplacesItsOwnMap) {
  EXPECT_EQ(saving().save_last(true), "");
  saving_ = nullptr;
  is_resumed_ = true;
  EXPECT_EQ(saving().save_last(false), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "still.1.cairn"));
}

}  // namespace
}  // namespace cairn
