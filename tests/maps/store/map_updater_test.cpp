#include "maps/store/map_updater.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <thread>

#include "tests/maps/store/store_fixture.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;

class MapUpdaterTest : public MapStore {
 protected:
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) all.push_back(entry.path().filename().string());
    return all;
  }
  [[nodiscard]] fs::path earlier() const { return file(".office.cairn.earlier"); }
};

// As a mission's map after so many autosaves: more cells known, more driven, another clock.
SavedMap grown(int saves, int tiles_side = 4) {
  SavedMap map = map_of_a_mission();
  std::mt19937_64 random(3);
  const int side = tiles_side * OccupancyGrid::kTileSide;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) map.grid.set_log_odds({x, y}, static_cast<LogOdds>(random() % 2000 - 1000));
  for (int i = 0; i < 20 * saves; ++i)
    map.grid.set_log_odds({i % side, 5}, static_cast<LogOdds>((17 * i + saves) % 1000));
  for (int i = 0; i < 5000 + 10 * saves; ++i) map.driven_path.push_back({0.05 * i, 0.0, 0.0});
  map.progress->time_s = saves;
  map.properties["tree_state"] = std::to_string(saves);
  return map;
}

// A deterministic change of any kind: rows come, change and go.
void change(SavedMap& map, std::mt19937_64& random) {
  const auto any = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  switch (any(7)) {
    case 0:
      for (int i = 0, x = any(300) - 150, y = any(200) - 100; i < 50; ++i)
        map.grid.set_log_odds({x + i, y}, static_cast<LogOdds>(any(1000)));
      break;
    case 1: {
      Landmark landmark;
      landmark.category = "circle";
      landmark.T_map_landmark = {0.1 * any(100), 1.0, 0.0};
      landmark.evidence = {{"circle", any(10), 0.61, 0.66, 0.5}};
      map.graph.add(landmark);
      break;
    }
    case 2:
      if (!map.graph.landmarks().empty()) map.graph.retire(map.graph.landmarks().begin()->first, "gone");
      break;
    case 3:
      map.driven_path.resize(map.driven_path.size() / 2);
      break;
    case 4:
      for (int i = 0; i < 100; ++i) map.driven_path.push_back({0.1 * any(1000), 0.0, 0.01 * i});
      break;
    case 5:
      map.properties["key " + std::to_string(any(5))] = std::string(static_cast<std::size_t>(any(5000)), 'x');
      break;
    default:
      map.progress = any(2) == 0 ? std::nullopt : map_of_a_mission().progress;
  }
  map.clusters = {};
}

TEST_F(MapUpdaterTest, TheFileHoldsEachMapThatIsSaved) {
  MapUpdater updater(file());
  for (const SavedMap& map : {small_map(), map_with_clusters(), map_of_a_mission(), map_with_trajectories(), SavedMap(),
                              map_of_a_mission(), small_map()}) {
    updater.save(map);
    expect_equal(load_map(file()), map);
  }
}

TEST_F(MapUpdaterTest, AfterManyChangesItIsTheMapThatAWholeSaveWrites) {
  MapUpdater updater(file());
  SavedMap map = map_of_a_mission();
  std::mt19937_64 random(5);
  for (int i = 0; i < 60; ++i) {
    change(map, random);
    updater.save(map);
    ASSERT_NO_FATAL_FAILURE(expect_equal(load_map(file()), map)) << i;
  }
  save_map(file("whole.cairn"), map);
  save_map(file("again.cairn"), load_map(file()));
  EXPECT_TRUE(bytes_of(file("again.cairn")) == bytes_of(file("whole.cairn")));
}

TEST_F(MapUpdaterTest, ASmallChangeWritesFewBytes) {
  MapUpdater updater(file());
  for (int i = 0; i < 3; ++i) updater.save(grown(i, 12));
  const auto size = static_cast<std::uint64_t>(fs::file_size(file()));
  ASSERT_GT(size, 1'000'000U);
  const std::uint64_t before = updater.bytes_written();
  updater.save(grown(3, 12));
  EXPECT_LT(updater.bytes_written() - before, 100'000U) << "of a file of " << size;
  EXPECT_GT(updater.bytes_written(), before);
}

TEST_F(MapUpdaterTest, WhatHasNotChangedIsNotWritten) {
  MapUpdater updater(file());
  for (int i = 0; i < 3; ++i) updater.save(grown(1));
  const std::uint64_t before = updater.bytes_written();
  updater.save(grown(1));
  EXPECT_EQ(updater.bytes_written(), before);
}

TEST_F(MapUpdaterTest, AFileThatHasNotGrownStaysAsLarge) {
  MapUpdater updater(file());
  for (int i = 0; i < 3; ++i) updater.save(grown(i));
  const std::uintmax_t before = fs::file_size(file());
  for (int i = 3; i < 25; ++i) updater.save(grown(i % 7));
  EXPECT_LT(fs::file_size(file()), before + before / 5);
}

TEST_F(MapUpdaterTest, TheFileStandsAloneAndTheOneBeforeGoesWithTheUpdater) {
  {
    MapUpdater updater(file());
    updater.save(grown(0));
    EXPECT_THAT(names(), ElementsAre("office.cairn"));
    for (int i = 1; i < 4; ++i) updater.save(grown(i));
    EXPECT_THAT(names(), testing::UnorderedElementsAre("office.cairn", ".office.cairn.earlier"));
    fs::copy_file(file(), file("copy.cairn"));
    expect_equal(load_map(file("copy.cairn")), grown(3));
    expect_equal(load_map(earlier()), grown(2));
    fs::remove(file("copy.cairn"));
  }
  EXPECT_THAT(names(), ElementsAre("office.cairn"));
}

// What a kill or a power cut leaves while the file before is changed: any of its bytes.
TEST_F(MapUpdaterTest, HoweverTheFileBeforeIsDamagedTheNextSaveIsRight) {
  MapUpdater updater(file());
  updater.save(grown(0));
  std::mt19937_64 random(9);
  for (int i = 1; i < 25; ++i) {
    updater.save(grown(i));
    expect_equal(load_map(file()), grown(i));
    std::string bytes = bytes_of(earlier());
    if (i % 5 == 0)
      bytes.resize(random() % bytes.size());
    else
      for (int n = 0; n < 40; ++n) bytes[random() % bytes.size()] = static_cast<char>(random());
    write_bytes(earlier(), bytes);
    if (i % 7 == 0) fs::remove(earlier());
  }
}

TEST_F(MapUpdaterTest, WhatAKilledProgramHasLeftBesideItIsNotUsed) {
  save_map(file(), grown(1));
  write_bytes(earlier(), "torn");
  MapUpdater updater(file());
  expect_equal(load_map(file()), grown(1));
  for (int i = 2; i < 5; ++i) {
    updater.save(grown(i));
    expect_equal(load_map(file()), grown(i));
  }
}

TEST_F(MapUpdaterTest, ALinkInThePlaceOfTheFileBeforeIsNotFollowed) {
  MapUpdater updater(file());
  for (int i = 0; i < 3; ++i) updater.save(grown(i));
  save_map(file("other.cairn"), small_map());
  const std::string other = bytes_of(file("other.cairn"));
  fs::remove(earlier());
  fs::create_symlink(file("other.cairn"), earlier());
  updater.save(grown(3));
  expect_equal(load_map(file()), grown(3));
  EXPECT_TRUE(bytes_of(file("other.cairn")) == other);
}

TEST_F(MapUpdaterTest, WhoHasTheMapOpenKeepsItsContent) {
  MapUpdater updater(file());
  for (int i = 0; i < 3; ++i) updater.save(grown(i));
  const MapFile open(file());
  for (int i = 3; i < 6; ++i) updater.save(grown(i));
  EXPECT_EQ(open.without_cells().progress->time_s, 2.0);
  EXPECT_EQ(open.grid_within({{0, 0}, {64, 64}}), part_of(grown(2).grid, {{0, 0}, {64, 64}}));
  expect_equal(load_map(file()), grown(5));
}

TEST_F(MapUpdaterTest, WhatIsNoMapIsLeftAsItIs) {
  write_bytes(file(), "a letter");
  MapUpdater updater(file());
  EXPECT_THROW(updater.save(small_map()), StoreError);
  EXPECT_EQ(bytes_of(file()), "a letter");
}

TEST_F(MapUpdaterTest, AMapThatWouldNotLoadAgainIsRefusedAndTheFileStays) {
  MapUpdater updater(file());
  for (int i = 0; i < 3; ++i) updater.save(grown(i));
  SavedMap bad = grown(3);
  bad.progress->distance_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(updater.save(bad), std::invalid_argument);
  expect_equal(load_map(file()), grown(2));
  updater.save(grown(3));
  expect_equal(load_map(file()), grown(3));
}

// Wherever the disk is full: writes beyond so many bytes of a file fail.
TEST_F(MapUpdaterTest, OnAFullDiskTheFileStaysAndTheNextSaveThatFitsIsRight) {
  const auto previous = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
  MapUpdater updater(file());
  for (int i = 0; i < 3; ++i) updater.save(grown(i));
  const auto size = static_cast<rlim_t>(fs::file_size(file()));
  int saved = 2;
  for (int i = 3; i < 20; ++i) {
    rlimit full = old;
    full.rlim_cur = size * static_cast<rlim_t>(i - 3) / 17;
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
    try {
      updater.save(grown(i));
      saved = i;
    } catch (const StoreError&) {
    }
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old), 0);
    expect_equal(load_map(file()), grown(saved));
    if (i % 3 == 0) updater.save(grown(saved = i));
    expect_equal(load_map(file()), grown(saved));
  }
  std::signal(SIGXFSZ, previous);
}

// In a process of its own: saves one map after the other and says which is saved.
[[noreturn]] void save_on_and_on(const fs::path& file, int saved) {
  MapUpdater updater(file);
  for (int i = 0;; ++i) {
    updater.save(grown(i, 2));
    if (::write(saved, &i, sizeof i) != sizeof i) std::_Exit(1);
  }
}

// CAIRN_KILLS=500 for more.
TEST_F(MapUpdaterTest, AfterAKillAtAnyMomentTheFileHoldsWhatWasSavedLast) {
  const char* const wanted = std::getenv("CAIRN_KILLS");
  const int kills = wanted == nullptr ? 15 : std::atoi(wanted);
  std::mt19937_64 random(13);
  for (int kill = 0; kill < kills; ++kill) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      ::close(ends[0]);
      save_on_and_on(file(), ends[1]);
    }
    ::close(ends[1]);
    int last = -1;
    for (std::uint64_t count = 3 + random() % 4; count > 0; --count)
      ASSERT_EQ(::read(ends[0], &last, sizeof last), static_cast<ssize_t>(sizeof last));
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 30000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(ends[0], &last, sizeof last) == static_cast<ssize_t>(sizeof last)) {
    }
    ::close(ends[0]);
    const SavedMap found = load_map(file());
    const int holds = static_cast<int>(found.progress->time_s);
    ASSERT_GE(holds, last);
    ASSERT_LE(holds, last + 1);
    expect_equal(found, grown(holds, 2));
  }
}

}  // namespace
}  // namespace cairn
