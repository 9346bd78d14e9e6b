#include "maps/hierarchy/hierarchy.hpp"
#include "maps/store/repair.hpp"
#include "tests/maps/store/store_fixture.hpp"

namespace cairn {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

testing::Matcher<StoreLoss> loss_in(const std::string& table, const std::string& what) {
  return AllOf(Field(&StoreLoss::table, table), Field(&StoreLoss::what, HasSubstr(what)));
}

// Enough for several pages in every large table.
SavedMap large_map() {
  SavedMap map;
  std::mt19937_64 random(3);
  map.grid = OccupancyGrid(0.1, 4.0, {1.0, 0.0});
  for (int i = 0; i < 60'000; ++i)
    map.grid.set_log_odds({static_cast<int>(random() % 512), static_cast<int>(random() % 512)},
                          static_cast<LogOdds>(static_cast<int>(random() % 2049) - 1024));
  for (int i = 0; i < 600; ++i) {
    Landmark landmark;
    landmark.name = "place " + std::to_string(i);
    landmark.T_map_landmark = {static_cast<double>(i % 30), i / 30.0, 0.0};
    map.graph.add(landmark);
  }
  for (LandmarkId id = 1; id < 600; ++id)
    map.graph.add_route({0, id, id + 1, 1.0, {{0, 0, 0}, {1, 0, 0}}, true, false, 0});
  map.clusters = Hierarchy(map.graph).tree();
  for (int i = 0; i < 500; ++i) map.driven_path.push_back({0.1 * i, 1.0, 0.0});
  map.properties = {{"mission", "office"}};
  return map;
}

class MapSalvage : public MapStore {
 protected:
  MapSalvage() { save_map(file("sound.cairn"), large_map()); }

  [[nodiscard]] SalvagedMap after(const std::string& sql) const {
    write_bytes(file(), bytes_of(file("sound.cairn")));
    run_sql(file(), sql);
    return salvage_map(file());
  }
};

TEST_F(MapSalvage, OfASoundFileIsTheMapAndNothingIsLost) {
  const SalvagedMap salvaged = salvage_map(file("sound.cairn"));
  EXPECT_THAT(salvaged.losses, IsEmpty());
  expect_equal(salvaged.map, large_map());
}

TEST_F(MapSalvage, ReadsTheStoredFile) {
  const SalvagedMap salvaged = salvage_map(stored_file());
  EXPECT_EQ(salvaged.version, 1);
  EXPECT_THAT(salvaged.losses, IsEmpty());
  expect_equal(salvaged.map, load_map(stored_file()));
}

TEST_F(MapSalvage, SaysWhereADamagedTileLies) {
  const SalvagedMap salvaged = after("UPDATE tiles SET log_odds = substr(log_odds, 1, 40) WHERE tx = 2 AND ty = 1");
  ASSERT_EQ(salvaged.losses.size(), 1U);
  EXPECT_THAT(salvaged.losses, Contains(loss_in("tiles", "tile (2, 1)")));
  ASSERT_TRUE(salvaged.losses[0].box);
  EXPECT_NEAR(salvaged.losses[0].box->min_m.x(), 1.0 + 12.8, 1e-9);
  EXPECT_NEAR(salvaged.losses[0].box->max_m.y(), 12.8, 1e-9);
  OccupancyGrid expected = large_map().grid;
  for (int y = 64; y < 128; ++y)
    for (int x = 128; x < 192; ++x) expected.set_log_odds({x, y}, 0);
  EXPECT_EQ(salvaged.map.grid, expected);
}

TEST_F(MapSalvage, DropsTheRoutesOfALostLandmarkAndMakesClustersAnew) {
  const SalvagedMap salvaged = after("UPDATE landmarks SET degree = 'much' WHERE id = 300");
  EXPECT_THAT(salvaged.losses, Contains(loss_in("landmarks", "row 300: column degree holds a text")));
  EXPECT_THAT(salvaged.losses, Contains(loss_in("routes", "row 299")));
  EXPECT_THAT(salvaged.losses, Contains(loss_in("routes", "row 300")));
  EXPECT_EQ(salvaged.map.graph.landmarks().size(), 599U);
  EXPECT_EQ(salvaged.map.graph.routes().size(), 597U);
  EXPECT_EQ(salvaged.map.clusters.cluster_of.size(), 599U);
  EXPECT_NO_THROW(save_map(file("repaired.cairn"), salvaged.map));
  EXPECT_THAT(salvage_map(file("repaired.cairn")).losses, IsEmpty());
}

TEST_F(MapSalvage, SaysThatAnEditedValueCannotBeReported) {
  EXPECT_THAT(after("UPDATE landmarks SET x_m = 7 WHERE id = 3").losses,
              Contains(loss_in("landmarks", "does not match its checksum")));
}

TEST_F(MapSalvage, SaysHowManyRowsAreMissing) {
  EXPECT_THAT(after("DELETE FROM driven_path WHERE number % 5 = 0").losses,
              Contains(loss_in("driven_path", "400 of its 500 rows")));
}

// Every third page in turn: what can be read stays right, and what is lost is reported.
TEST_F(MapSalvage, OfAFileWithAnyOnePageDestroyed) {
  const SavedMap map = large_map();
  const std::string sound = bytes_of(file("sound.cairn"));
  std::size_t mostly_lost = 0;
  for (std::size_t page = 1; page < sound.size() / 4096; page += 3) {
    SCOPED_TRACE("page " + std::to_string(page + 1));
    std::string damaged = sound;
    damaged.replace(page * 4096, 4096, std::string(4096, '\x5a'));
    write_bytes(file(), damaged);
    SalvagedMap salvaged;
    try {
      salvaged = salvage_map(file());
    } catch (const StoreError& error) {
      FAIL() << error.what();  // no page is all of the map
    }
    const bool is_all = salvaged.map.graph == map.graph && salvaged.map.grid == map.grid &&
                        salvaged.map.driven_path == map.driven_path && salvaged.map.properties == map.properties &&
                        salvaged.map.clusters == map.clusters;
    EXPECT_TRUE(is_all || !salvaged.losses.empty());
    for (const auto& [id, landmark] : salvaged.map.graph.landmarks()) ASSERT_EQ(landmark, *map.graph.find(id));
    if (salvaged.map.graph.landmarks().size() < 450) ++mostly_lost;
    if (page % 8 != 0) continue;
    save_map(file("repaired.cairn"), salvaged.map);
    EXPECT_NO_THROW((void)load_map(file("repaired.cairn")));
  }
  EXPECT_LE(mostly_lost, 1U);  // the page at the root of their table
}

TEST_F(MapSalvage, ReadsEveryTilePastADamagedIndex) {
  std::string bytes = bytes_of(file("sound.cairn"));
  std::size_t page = 0;
  for (sqlite3* database = nullptr; database == nullptr; sqlite3_close(database)) {
    ASSERT_EQ(sqlite3_open(file("sound.cairn").c_str(), &database), SQLITE_OK);
    const auto take = [](void* to, int, char** values, char**) {
      *static_cast<std::size_t*>(to) = std::stoul(values[0]);
      return 0;
    };
    const char* const index = "SELECT rootpage FROM sqlite_schema WHERE type = 'index' AND tbl_name = 'tiles'";
    ASSERT_EQ(sqlite3_exec(database, index, take, &page, nullptr), SQLITE_OK);
  }
  ASSERT_GT(page, 1U);
  bytes.replace((page - 1) * 4096, 4096, std::string(4096, '\x5a'));
  write_bytes(file(), bytes);
  EXPECT_THROW((void)load_map(file()), StoreError);
  const SalvagedMap salvaged = salvage_map(file());
  EXPECT_THAT(salvaged.losses, testing::ElementsAre(loss_in("tiles", "index")));
  expect_equal(salvaged.map, large_map());
}

TEST_F(MapSalvage, ReadsAllPastADamagedHeader) {
  for (const std::size_t at : {3U, 68U}) {
    std::string bytes = bytes_of(file("sound.cairn"));
    bytes[at] ^= '\x40';
    write_bytes(file(), bytes);
    const SalvagedMap salvaged = salvage_map(file());
    EXPECT_EQ(salvaged.version, 1);
    EXPECT_THAT(salvaged.losses, testing::ElementsAre(loss_in("header of the file", "made anew")));
    expect_equal(salvaged.map, large_map());
  }
  write_bytes(file(), std::string(3 * 4096, 'x'));
  EXPECT_THROW((void)salvage_map(file()), StoreError);
}

TEST_F(MapSalvage, SaysInTheMapWhatItHasKeptUnproven) {
  const SalvagedMap salvaged = after("UPDATE landmarks SET x_m = 7 WHERE id = 3");
  EXPECT_EQ(salvaged.map.properties.at(kUnprovenTables), "landmarks");
  EXPECT_FALSE(salvage_map(file("sound.cairn")).map.properties.contains(kUnprovenTables));
}

TEST_F(MapSalvage, SaysThatWhatHasNoChecksumIsNotProven) {
  const SalvagedMap salvaged =
      after("DELETE FROM checksums WHERE table_name = 'landmarks'; UPDATE landmarks SET x_m = x_m + 1");
  EXPECT_EQ(salvaged.map.properties.at(kUnprovenTables), "landmarks");
}

TEST_F(MapSalvage, OfATruncatedFile) {
  const std::string sound = bytes_of(file("sound.cairn"));
  std::size_t max_kept = 0;
  for (const std::size_t tenths : {9, 7, 5, 3}) {
    write_bytes(file(), sound.substr(0, sound.size() * tenths / 10));
    const SalvagedMap salvaged = salvage_map(file());
    EXPECT_THAT(salvaged.losses, testing::Not(IsEmpty()));
    max_kept = std::max(max_kept, salvaged.map.graph.landmarks().size());
    save_map(file("repaired.cairn"), salvaged.map);
  }
  EXPECT_EQ(max_kept, 600U);
}

// The definitions of the tables lie behind the first pages of content.
TEST_F(MapSalvage, OfAFileThatHasLostTheDefinitionsOfItsTables) {
  write_bytes(file(), bytes_of(file("sound.cairn")).substr(0, std::size_t{16} * 4096));
  auto properties = salvage_map(file()).map.properties;
  EXPECT_EQ(properties.at(kUnprovenTables), "meta, grid, clusters, next_ids") << "the checksums are lost too";
  properties.erase(kUnprovenTables);
  EXPECT_EQ(properties, large_map().properties);
}

TEST_F(MapSalvage, RefusesWhatIsNoSavedMapOrTooNew) {
  const auto refusal = [this](const std::string& bytes) {
    write_bytes(file(), bytes);
    try {
      (void)salvage_map(file());
    } catch (const StoreError& error) {
      return std::string(error.what());
    }
    return std::string("salvaged");
  };
  std::string newer = bytes_of(file("sound.cairn"));
  newer[63] = 9;
  EXPECT_THAT(refusal(newer), HasSubstr("was written with schema version 9"));
  EXPECT_THAT(refusal("mission: office\n"), HasSubstr("is not a saved map"));
  EXPECT_THAT(refusal(""), HasSubstr("is empty"));
}

}  // namespace
}  // namespace cairn
