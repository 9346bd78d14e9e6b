// What a saved map file may be made of, and what load_map says to it.
#include <algorithm>
#include <bit>
#include <cstdint>

#include "maps/store/repair.hpp"
#include "tests/maps/store/store_fixture.hpp"

namespace cairn {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(MapStore, RefusesWhatIsNoSavedMap) {
  EXPECT_EQ(refusal_of(file()), "no such file");
  EXPECT_EQ(refusal_of(folder_), "is not a file");
  write_bytes(file(), "");
  EXPECT_EQ(refusal_of(file()), "is empty");
  write_bytes(file(), "P5 10 10 255");
  EXPECT_EQ(refusal_of(file()), "is not a saved map (no SQLite 3 file)");
  write_bytes(file(), "\x1f\x8b\x08");
  EXPECT_EQ(refusal_of(file()), "is packed by gzip: unpack it with gunzip");
  fs::remove(file());
  run_sql(file(), "CREATE TABLE t (a)");
  EXPECT_EQ(refusal_of(file()),
            "is not a saved map (an SQLite file of another program: application_id 0, a map has 1129467441)");
}

TEST_F(MapStore, RefusesNewerAndUnknownVersions) {
  EXPECT_EQ(refusal_after("PRAGMA user_version = 3"),
            "was written with schema version 3, this Cairn reads up to version 2: use a newer Cairn");
  EXPECT_EQ(refusal_after("PRAGMA user_version = -1"), "has schema version -1, the first one is 1");
}

TEST_F(MapStore, RefusesTextsThatSteerATerminal) {
  for (const auto& [sql, told] : std::initializer_list<std::pair<const char*, const char*>>{
           {"UPDATE landmarks SET name = 'a' || char(27) || '[2J' WHERE id = 1",
            "table landmarks: column name holds the control character \\x1b"},
           {"UPDATE landmarks SET category = char(8238) WHERE id = 1",
            "table landmarks: column category holds the control character \\u202e"},
           {"UPDATE shapes SET category = char(155)",
            "table shapes: column category holds the control character \\u009b"},
           {"UPDATE shapes SET kind = 'x' || char(10)", "table shapes: kind \"x\\n\" is not circle"},
           {"UPDATE meta SET value = char(127) WHERE key = 'note'",
            "table meta: column value holds the control character \\u007f"}}) {
    write_bytes(file(), small_map_bytes());
    run_sql(file(), sql);
    const SalvagedMap salvaged = salvage_map(file());
    EXPECT_TRUE(std::ranges::any_of(salvaged.losses, [&, text = std::string(told)](const StoreLoss& loss) {
      return ("table " + loss.table + ": " + loss.what).find(text.substr(text.find(": ") + 2)) != std::string::npos &&
             text.starts_with("table " + loss.table);
    })) << sql;
  }
}

TEST_F(MapStore, RefusesATruncatedFileAtEveryLength) {
  const std::string& whole = small_map_bytes();
  for (std::size_t size = 1; size < whole.size(); size += 509) {
    write_bytes(file(), whole.substr(0, size));
    EXPECT_THAT(refusal_of(file()), testing::AnyOf(StartsWith("is truncated"), HasSubstr("no SQLite 3 file"))) << size;
  }
}

TEST_F(MapStore, AFlippedByteIsRefusedOrChangesNothing) {
  const std::string& whole = small_map_bytes();
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); at += 47) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
    write_bytes(file(), flipped);
    try {
      expect_equal(load_map(file()), small_map());
    } catch (const StoreError&) {
      ++refused;
    }
    ASSERT_FALSE(HasFailure()) << "byte " << at;
  }
  EXPECT_GT(refused, 100);
}

TEST_F(MapStore, RandomDamageIsRefusedOrChangesNothing) {
  const std::string& whole = small_map_bytes();
  std::mt19937_64 random(11);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = whole;
    for (std::uint64_t left = 1 + random() % 40; left > 0; --left)
      damaged[100 + random() % (damaged.size() - 100)] = static_cast<char>(random());
    write_bytes(file(), damaged);
    try {
      expect_equal(load_map(file()), small_map());
    } catch (const StoreError&) {
    }
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
}

TEST_F(MapStore, NamesTheTileThatIsDamaged) {
  EXPECT_EQ(refusal_after("UPDATE tiles SET log_odds = CAST(substr(log_odds, 1, 99) || x'00' || substr(log_odds, 101) "
                          "AS BLOB) WHERE tx = -1 AND ty = 0"),
            "table tiles: tile (-1, 0) is damaged: its bytes do not unpack to 8192 bytes");
}

TEST_F(MapStore, NamesTheTableThatWasEdited) {
  EXPECT_EQ(refusal_after("UPDATE landmarks SET x_m = 3 WHERE id = 1"),
            "table landmarks: its content does not match its checksum, it was damaged or edited");
  EXPECT_EQ(refusal_after("DELETE FROM driven_path WHERE number = 2"), "table driven_path: has 2 rows, saved were 3");
  EXPECT_EQ(refusal_after("DELETE FROM checksums WHERE table_name = 'routes'"),
            "table checksums: has no row for table routes");
  EXPECT_EQ(refusal_after("DROP TABLE shapes"), "table shapes: is missing");
  EXPECT_EQ(refusal_after("ALTER TABLE grid ADD COLUMN extra"),
            "table grid: its columns are not those of schema version 1");
  EXPECT_EQ(refusal_after("DROP TABLE meta; CREATE VIEW meta AS SELECT 1 AS key, 2 AS value"),
            "table meta: is missing");
}

// An edit that also forges the checksums, so that only the checks of the values are left.
class ForgedMap : public MapStore {
 protected:
  [[nodiscard]] std::string refusal_after_forging(const std::string& sql) const {
    return refusal_after_forging(sql, small_map_bytes());
  }
  [[nodiscard]] std::string refusal_after_forging(const std::string& sql, const std::string& map_bytes) const;
};

// CRC-32 as zlib computes it, and a row's canonical bytes: written again here so that the format is
// tested and not only the code that made it.
std::uint32_t crc32_by_bits(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

void append_bits(std::string& bytes, std::uint64_t bits) {
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<char>(bits >> (8 * i)));
}

std::string canonical_row(sqlite3_stmt* row) {
  std::string bytes;
  for (int column = 0; column < sqlite3_column_count(row); ++column) {
    const int type = sqlite3_column_type(row, column);
    bytes.push_back(static_cast<char>(type));
    if (type == SQLITE_INTEGER) append_bits(bytes, static_cast<std::uint64_t>(sqlite3_column_int64(row, column)));
    if (type == SQLITE_FLOAT) append_bits(bytes, std::bit_cast<std::uint64_t>(sqlite3_column_double(row, column)));
    if (type == SQLITE_TEXT) {
      const std::string text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
      append_bits(bytes, text.size());
      bytes += text;
    }
  }
  return bytes;
}

void forge_checksum(const fs::path& file, const std::string& table) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  sqlite3_stmt* row = nullptr;
  const std::string sql = "SELECT * FROM " + table + (table == "tiles" ? " ORDER BY level, ty, tx" : "");
  ASSERT_EQ(sqlite3_prepare_v2(database, sql.c_str(), -1, &row, nullptr), SQLITE_OK);
  std::string bytes;
  int rows = 0;
  for (; sqlite3_step(row) == SQLITE_ROW; ++rows) bytes += canonical_row(row);
  sqlite3_finalize(row);
  sqlite3_close(database);
  run_sql(file, "UPDATE checksums SET row_count = " + std::to_string(rows) +
                    ", crc32 = " + std::to_string(crc32_by_bits(bytes)) + " WHERE table_name = '" + table + "'");
}

std::string ForgedMap::refusal_after_forging(const std::string& sql, const std::string& map_bytes) const {
  write_bytes(file(), map_bytes);
  run_sql(file(), sql);
  for (const char* table : {"meta", "grid", "tiles", "landmarks", "landmark_templates", "routes", "clusters",
                            "landmark_clusters", "next_ids", "shapes", "driven_path"})
    forge_checksum(file(), table);
  return refusal_of(file());
}

TEST_F(ForgedMap, LoadsWhenNothingElseIsWrong) {
  EXPECT_EQ(refusal_after_forging("UPDATE landmarks SET x_m = 3 WHERE id = 1"), "loaded");
  EXPECT_EQ(load_map(file()).graph.find(1)->T_map_landmark.x_m, 3.0);
}

TEST_F(ForgedMap, RefusesImpossibleGrids) {
  EXPECT_EQ(refusal_after_forging("UPDATE grid SET cell_m = 0"),
            "table grid: cell_m must be in [0.000001, 1000], is 0.000000");
  EXPECT_EQ(refusal_after_forging("UPDATE grid SET cell_m = 1e-300"),
            "table grid: cell_m must be in [0.000001, 1000], is 0.000000");
  EXPECT_EQ(refusal_after_forging("UPDATE grid SET cell_m = 9e999"), "table grid: column cell_m is not finite");
  EXPECT_EQ(refusal_after_forging("UPDATE grid SET clamp_nat = -4"),
            "table grid: clamp_nat must be in (0, 127], is -4.000000");
  EXPECT_EQ(refusal_after_forging("UPDATE grid SET max_x = 1e5, max_y = 1e5"),
            "table grid: bounds of 100070 x 100003 cells are not possible, at most 268435456 cells are");
  EXPECT_EQ(refusal_after_forging("UPDATE grid SET max_x = -71"),
            "table grid: bounds of -1 x 73 cells are not possible, at most 268435456 cells are");
  EXPECT_EQ(refusal_after_forging("UPDATE grid SET max_y = 9223372036854775807"),
            "table grid: column max_y holds 9223372036854775807, allowed is -131072 to 131072");
  EXPECT_EQ(refusal_after_forging("UPDATE grid SET origin_x_m = 'left'"),
            "table grid: column origin_x_m holds a text where a number belongs");
  EXPECT_EQ(refusal_after_forging("DELETE FROM grid"), "table grid: has no row");
  EXPECT_EQ(refusal_after_forging("INSERT INTO grid SELECT 1, cell_m, 0, 0, clamp_nat, 0, 0, 1, 1 FROM grid"),
            "table grid: has more than one row, this version knows one level");
}

TEST_F(ForgedMap, RefusesImpossibleTiles) {
  EXPECT_EQ(refusal_after_forging("UPDATE tiles SET tx = 1000 WHERE tx = 0 AND ty = 0"),
            "table tiles: tile (1000, 0) has known cells outside the grid's bounds");
  EXPECT_EQ(refusal_after_forging("UPDATE tiles SET tx = 4611686018427387904 WHERE tx = 0 AND ty = 0"),
            "table tiles: column tx holds 4611686018427387904, allowed is -2048 to 2048");
  EXPECT_EQ(refusal_after_forging("UPDATE grid SET clamp_nat = 1"),
            "table tiles: tile (-1, -1) holds log-odds beyond the grid's clamp");
  EXPECT_EQ(refusal_after_forging("UPDATE tiles SET crc32 = 5 WHERE tx = 0 AND ty = 0"),
            "table tiles: tile (0, 0) is damaged: its bytes do not match its checksum");
  EXPECT_EQ(refusal_after_forging("UPDATE tiles SET log_odds = x'' WHERE tx = 0 AND ty = 0"),
            "table tiles: tile (0, 0) is damaged: 0 bytes cannot unpack to 8192");
  EXPECT_EQ(refusal_after_forging("UPDATE tiles SET level = 3 WHERE tx = 0 AND ty = 0"),
            "table tiles: column level holds 3, allowed is 0 to 0");
}

TEST_F(ForgedMap, RefusesDanglingAndImpossibleRoutes) {
  EXPECT_EQ(refusal_after_forging("UPDATE routes SET to_landmark = 99 WHERE id = 1"),
            "table routes: route 1: there is no landmark 99");
  EXPECT_EQ(refusal_after_forging("UPDATE routes SET cost_m = -1 WHERE id = 1"),
            "table routes: route 1: cost_m must be finite and not negative, got -1.000000");
  EXPECT_EQ(refusal_after_forging("UPDATE routes SET poses = 10000000 WHERE id = 1"),
            "table routes: the trajectory of route 1 is damaged: its bytes end before its poses do");
  EXPECT_EQ(refusal_after_forging("UPDATE routes SET poses = 2 WHERE id = 1"),
            "table routes: the trajectory of route 1 is damaged: more bytes follow its poses");
  EXPECT_EQ(refusal_after_forging("UPDATE routes SET poses = -1 WHERE id = 1"),
            "table routes: column poses holds -1, allowed is 0 to 10000000");
  EXPECT_EQ(refusal_after_forging("UPDATE routes SET annotations = '[1]' WHERE id = 1"),
            "table routes: column annotations holds no JSON object");
  EXPECT_EQ(refusal_after_forging("UPDATE routes SET speed_limit_mps = 'slow' WHERE id = 1"),
            "table routes: column speed_limit_mps holds a text where a number belongs");
  EXPECT_EQ(refusal_after_forging("UPDATE routes SET closed = 2 WHERE id = 1"),
            "table routes: column closed holds 2, allowed is 0 to 1");
}

TEST_F(ForgedMap, RefusesImpossibleLandmarks) {
  EXPECT_EQ(refusal_after_forging("UPDATE landmarks SET id = -4 WHERE id = 1"),
            "table landmarks: column id holds -4, allowed is 1 to 9007199254740991");
  EXPECT_EQ(refusal_after_forging("UPDATE landmarks SET access_y_m = NULL WHERE id = 1"),
            "table landmarks: column access_y_m holds nothing where a number belongs");
  EXPECT_EQ(refusal_after_forging("UPDATE landmarks SET category = x'00' WHERE id = 1"),
            "table landmarks: column category holds a blob where a text belongs");
  EXPECT_EQ(refusal_after_forging("UPDATE landmarks SET annotations = '{\"a\":' WHERE id = 1"),
            "table landmarks: column annotations holds no JSON object");
  EXPECT_EQ(refusal_after_forging("UPDATE landmarks SET sightings = -3 WHERE id = 1"),
            "table landmarks: column sightings holds -3, allowed is 0 to 2147483647");
  EXPECT_EQ(refusal_after_forging("UPDATE landmark_templates SET landmark = 77"),
            "table landmark_templates: there is no landmark 77");
  EXPECT_EQ(refusal_after_forging("UPDATE next_ids SET id = 9223372036854775807"),
            "table next_ids: column id holds 9223372036854775807, allowed is 1 to 9007199254740992");
  EXPECT_EQ(refusal_after_forging("DELETE FROM next_ids WHERE kind = 'route'"), "table next_ids: has no row for route");
}

TEST_F(ForgedMap, RefusesImpossibleClusters) {
  save_map(file("clusters.cairn"), map_with_clusters());
  const std::string bytes = bytes_of(file("clusters.cairn"));
  const auto refusal = [&](const std::string& sql) { return refusal_after_forging(sql, bytes); };
  EXPECT_EQ(refusal("UPDATE clusters SET name = 'desk' WHERE id = 3"), "loaded");
  EXPECT_EQ(refusal("UPDATE clusters SET level = 0 WHERE id = 3"),
            "table clusters: column level holds 0, allowed is 1 to 64");
  EXPECT_EQ(refusal("UPDATE clusters SET parent = 9 WHERE id = 3"), "table clusters: cluster 3: there is no cluster 9");
  EXPECT_EQ(refusal("UPDATE clusters SET parent = 3 WHERE id = 3"),
            "table clusters: cluster 3 of level 1 has a parent of level 1");
  EXPECT_EQ(refusal("UPDATE clusters SET parent = 2 WHERE id = 5"),
            "table clusters: cluster 5 of level 2 has a parent of level 1");
  EXPECT_EQ(refusal("UPDATE clusters SET parent = 0 WHERE id = 3"),
            "table clusters: cluster 3 of level 1 has no parent, the highest level is 2");
  EXPECT_EQ(refusal("UPDATE clusters SET anchor = 2 WHERE id = 3"),
            "table clusters: cluster 3: there is no landmark 2");
  EXPECT_EQ(refusal("INSERT INTO clusters VALUES (6, 2, 0, 1, '')"), "table clusters: cluster 6 holds no cluster");
  EXPECT_EQ(refusal("UPDATE next_ids SET id = 5 WHERE kind = 'cluster'"),
            "table clusters: cluster 5 is not below the next id, 5");
  EXPECT_EQ(refusal("DELETE FROM next_ids WHERE kind = 'cluster'"), "table next_ids: has no row for cluster");
  EXPECT_EQ(refusal("UPDATE landmark_clusters SET cluster = 9 WHERE landmark = 1"),
            "table landmark_clusters: there is no cluster 9");
  EXPECT_EQ(refusal("UPDATE landmark_clusters SET cluster = 5 WHERE landmark = 1"),
            "table landmark_clusters: landmark 1 is in cluster 5 of level 2, landmarks are in clusters of level 1");
  EXPECT_EQ(refusal("INSERT INTO landmark_clusters VALUES (77, 2)"),
            "table landmark_clusters: there is no landmark 77");
  EXPECT_EQ(refusal("UPDATE landmark_clusters SET cluster = 3"),
            "table landmark_clusters: cluster 2 holds no landmark");
  EXPECT_EQ(refusal("DELETE FROM landmark_clusters"), "table landmark_clusters: cluster 2 holds no landmark");
  EXPECT_EQ(refusal("INSERT INTO landmarks SELECT 6, level, '', '', 0.0, 0.0, 0.0, degree, 0, NULL, NULL, NULL, '' "
                    "FROM landmarks WHERE id = 4"),
            "table landmark_clusters: only 2 of 3 landmarks are in a cluster");
}

TEST_F(ForgedMap, RefusesImpossibleShapes) {
  EXPECT_EQ(refusal_after_forging("UPDATE shapes SET kind = 'star' WHERE number = 1"),
            "table shapes: kind \"star\" is not circle, polygon or polygons");
  EXPECT_EQ(refusal_after_forging("UPDATE shapes SET parameters = '0,0 1,x' WHERE number = 1"),
            "table shapes: a number is expected at \"x\"");
  EXPECT_EQ(refusal_after_forging("UPDATE shapes SET parameters = '0,0;1,1' WHERE number = 1"),
            "table shapes: ' ' is expected at \";1,1\"");
  EXPECT_THAT(refusal_after_forging("UPDATE shapes SET parameters = '0,0 1,0' WHERE number = 1"),
              AllOf(StartsWith("table shapes: "), HasSubstr("3 corners")));
  EXPECT_THAT(refusal_after_forging("UPDATE shapes SET parameters = '-1' WHERE number = 2"),
              StartsWith("table shapes: "));
  EXPECT_THAT(refusal_after_forging("UPDATE shapes SET parameters = 'nan' WHERE number = 2"),
              StartsWith("table shapes: "));
}

}  // namespace
}  // namespace cairn
