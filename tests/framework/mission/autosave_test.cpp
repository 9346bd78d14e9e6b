#include "framework/mission/autosave.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "tests/framework/modules/test_clock.hpp"

namespace cairn {
namespace {

using namespace std::chrono_literals;

class AutosaverTest : public testing::Test {
 protected:
  AutosaverTest() { std::filesystem::create_directories(folder_); }
  ~AutosaverTest() override { std::filesystem::remove_all(folder_); }

  static SavedMap map_at(double time_s) {
    SavedMap map;
    map.progress = MissionProgress{.time_s = time_s};
    return map;
  }
  // What has come of the copy, once it is written.
  static Autosaver::Outcome outcome_of(Autosaver& autosaver) {
    while (true) {
      if (auto outcome = autosaver.last_outcome()) return *outcome;
      std::this_thread::yield();
    }
  }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      all.push_back(entry.path().filename().string());
    std::ranges::sort(all);
    return all;
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("cairn_autosave_" + std::to_string(getpid()) + "_" +
                                                   testing::UnitTest::GetInstance()->current_test_info()->name());
  const std::filesystem::path file_ = folder_ / "a.autosave.cairn";
  const std::shared_ptr<TestClock> clock_ = std::make_shared<TestClock>();
};

TEST_F(AutosaverTest, IsNeverDueWithoutAnInterval) {
  Autosaver autosaver(file_, 0.0, clock_);
  EXPECT_FALSE(autosaver.is_due());
  clock_->advance(1h);
  EXPECT_FALSE(autosaver.is_due());
}

TEST_F(AutosaverTest, IsDueAtOnceAndThenWhenTheIntervalIsOver) {
  Autosaver autosaver(file_, 30.0, clock_);
  EXPECT_TRUE(autosaver.is_due());
  autosaver.save(map_at(1.0), clock_->now());
  EXPECT_TRUE(outcome_of(autosaver).saved);
  EXPECT_FALSE(autosaver.is_due());
  for (int second = 1; second < 29; ++second) {
    clock_->advance(1s);
    EXPECT_FALSE(autosaver.is_due()) << second;
  }
  clock_->advance(1s);
  EXPECT_TRUE(autosaver.is_due()) << "as early as a tick is long, so that it is over in time";
}

TEST_F(AutosaverTest, WritesTheCopyAndSaysWhatItHolds) {
  Autosaver autosaver(file_, 30.0, clock_);
  autosaver.save(map_at(12.5), clock_->now());
  const Autosaver::Outcome outcome = outcome_of(autosaver);
  EXPECT_TRUE(outcome.saved);
  EXPECT_EQ(outcome.time_s, 12.5);
  EXPECT_EQ(load_map(file_).progress->time_s, 12.5);
  EXPECT_EQ(autosaver.figures().saved, 1);
  EXPECT_EQ(autosaver.figures().last_time_s, 12.5);
  EXPECT_FALSE(autosaver.last_outcome()) << "once";
}

TEST_F(AutosaverTest, FinishWaitsForWhatIsBeingWritten) {
  Autosaver autosaver(file_, 30.0, clock_);
  autosaver.save(map_at(3.0), clock_->now());
  autosaver.finish();
  EXPECT_TRUE(std::filesystem::exists(file_));
  EXPECT_EQ(autosaver.figures().saved, 1);
}

TEST_F(AutosaverTest, AFileThatCannotBeWrittenIsCountedWithTheFirstReason) {
  std::filesystem::create_directories(file_);
  Autosaver autosaver(file_, 30.0, clock_);
  autosaver.save(map_at(3.0), clock_->now());
  const Autosaver::Outcome outcome = outcome_of(autosaver);
  EXPECT_FALSE(outcome.saved);
  EXPECT_FALSE(outcome.reason.empty());
  EXPECT_EQ(autosaver.figures().failed, 1);
  EXPECT_EQ(autosaver.figures().failure, outcome.reason);
}

TEST_F(AutosaverTest, ALaterAutosaveWritesOnlyWhatHasChanged) {
  Autosaver autosaver(file_, 30.0, clock_);
  SavedMap map = map_at(1.0);
  for (int i = 0; i < 20000; ++i) map.driven_path.push_back({0.05 * i, 0.0, 0.1});
  std::uint64_t before = 0;
  for (int i = 0; i < 4; ++i) {
    before = autosaver.figures().written_bytes;
    map.progress->time_s = i;
    map.driven_path.push_back({0.0, 0.05 * i, 0.1});
    autosaver.save(map, clock_->now());
    ASSERT_TRUE(outcome_of(autosaver).saved);
  }
  EXPECT_EQ(load_map(file_).driven_path, map.driven_path);
  ASSERT_GT(std::filesystem::file_size(file_), 500'000U);
  EXPECT_LT(autosaver.figures().written_bytes - before, 50'000U);
  autosaver.finish();
  EXPECT_EQ(names().size(), 1U) << "nothing is left beside it";
}

TEST_F(AutosaverTest, TheAutosaveOfAnEarlierRunIsKept) {
  EXPECT_FALSE(keep_earlier_autosave(file_));
  save_map(file_, map_at(5.0));
  const auto kept = keep_earlier_autosave(file_);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->file, folder_ / "a.autosave.1.cairn");
  EXPECT_EQ(kept->removed, 0);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(AutosaverTest, ALinkIsNoAutosaveOfAnEarlierRun) {
  save_map(folder_ / "b.cairn", map_at(5.0));
  std::filesystem::create_symlink("b.cairn", file_);
  EXPECT_FALSE(keep_earlier_autosave(file_));
  EXPECT_FALSE(keep_under_free_name(file_));
  EXPECT_EQ(names(), (std::vector<std::string>{"a.autosave.cairn", "b.cairn"}));
}

// A run that is started again and again, and fails each time.
TEST_F(AutosaverTest, TwoAutosavesAreKeptHoweverManyRunsDoNotEnd) {
  for (const double time_s : {3.0, 1.0, 80000.0, 2.0, 2.0, 5.0}) {
    static_cast<void>(keep_earlier_autosave(file_));
    save_map(file_, map_at(time_s));
  }
  EXPECT_EQ(names(), (std::vector<std::string>{"a.autosave.1.cairn", "a.autosave.cairn"}));
  EXPECT_EQ(load_map(folder_ / "a.autosave.1.cairn").progress->time_s, 80000.0) << "the one that had come furthest";
  EXPECT_EQ(load_map(file_).progress->time_s, 5.0);
}

TEST_F(AutosaverTest, OfThoseThatHoldAsMuchTheLastIsKept) {
  SavedMap map = map_at(3.0);
  save_map(folder_ / "a.autosave.1.cairn", map);
  map.properties["note"] = "later";
  save_map(file_, map);
  EXPECT_EQ(keep_earlier_autosave(file_)->removed, 1);
  EXPECT_EQ(load_map(folder_ / "a.autosave.1.cairn").properties["note"], "later");
}

TEST_F(AutosaverTest, AllThatEarlierVersionsHaveKeptBecomeOne) {
  for (int i = 1; i <= 6; ++i)
    save_map(folder_ / ("a.autosave." + std::to_string(i) + ".cairn"), map_at(i == 4 ? 100.0 : i));
  std::ofstream(folder_ / "a.autosave.old.cairn") << "of somebody else";
  std::ofstream(folder_ / "b.autosave.1.cairn") << "of another mission";
  std::ofstream(file_) << "damaged";
  EXPECT_EQ(keep_earlier_autosave(file_)->removed, 6);
  EXPECT_EQ(names(), (std::vector<std::string>{"a.autosave.1.cairn", "a.autosave.old.cairn", "b.autosave.1.cairn"}));
  EXPECT_EQ(load_map(folder_ / "a.autosave.1.cairn").progress->time_s, 100.0);
}

TEST_F(AutosaverTest, TheMapThatARunGoesOnFromIsNotTouched) {
  const std::filesystem::path resumed = folder_ / "a.autosave.1.cairn";
  save_map(resumed, map_at(3.0));
  save_map(file_, map_at(9.0));
  EXPECT_EQ(keep_earlier_autosave(file_, resumed)->file, folder_ / "a.autosave.2.cairn");
  EXPECT_EQ(load_map(resumed).progress->time_s, 3.0);
}

TEST_F(AutosaverTest, AFileIsKeptUnderTheNextFreeName) {
  EXPECT_FALSE(keep_under_free_name(folder_ / "a.cairn"));
  std::ofstream(folder_ / "a.1.cairn") << "taken";
  std::ofstream(folder_ / "a.cairn") << "earlier";
  EXPECT_EQ(keep_under_free_name(folder_ / "a.cairn"), folder_ / "a.2.cairn");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.cairn"));
}

}  // namespace
}  // namespace cairn
