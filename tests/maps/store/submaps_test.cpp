// Submaps and their pose graph in the saved map.
#include "maps/store/repair.hpp"
#include "maps/store/value_check.hpp"
#include "tests/maps/store/store_fixture.hpp"

namespace cairn {
namespace {

using testing::HasSubstr;

KeptSubmap submap_at(std::int64_t anchor, std::vector<Point> points_m) {
  KeptSubmap submap;
  submap.anchor = anchor;
  submap.finished = anchor == 0;
  set_echoes(submap, points_m);
  return submap;
}

SavedMap map_with_submaps() {
  SavedMap map = map_of_a_mission();
  map.submaps.nodes = {{0, 0.0, {0.1, -0.2, 0.3}}, {1, 2.5, {0.6, 1.0 / 3.0, 0.4}}, {2, 4.0, {1.1, 0.3, -0.0}}};
  map.submaps.submaps = {submap_at(0, {{1.0, 2.0}, {1.01, 2.01}, {-3.0, 0.5}}), submap_at(2, {})};
  Eigen::Matrix3d information;
  information << 400.0, -3.0, 0.5, -3.0, 300.0, 0.25, 0.5, 0.25, 1000.0;
  map.submaps.edges = {{0, 1, {0.5, 0.0, 0.1}, information, false, true},
                       {0, 2, {1.0, 0.1, 0.0}, information, true, false}};
  return map;
}

std::string version_byte_of(const fs::path& file) {
  return bytes_of(file).substr(60, 4);
}

TEST_F(MapStore, KeepsSubmapsToTheBit) {
  const SavedMap map = map_with_submaps();
  save_map(file(), map);
  expect_equal(load_map(file()), map);
  EXPECT_EQ(MapFile(file()).without_cells().submaps, map.submaps);
  EXPECT_EQ(schema_version_of(file()), 2);
  const std::string before = bytes_of(file());
  save_map(file(), load_map(file()));
  EXPECT_EQ(bytes_of(file()), before);
}

TEST_F(MapStore, AMapWithoutSubmapsIsOneOfVersionOne) {
  save_map(file(), map_of_a_mission());
  EXPECT_EQ(schema_version_of(file()), 1);
  EXPECT_EQ(version_byte_of(file()), std::string("\0\0\0\1", 4));
  EXPECT_TRUE(load_map(file()).submaps.empty());
}

TEST_F(MapStore, SubmapsThatAreDamagedAreRefusedAndLeftOutByRepair) {
  const auto after = [&](const std::string& sql) {
    save_map(file(), map_with_submaps());
    run_sql(file(), sql);
    EXPECT_NE(refusal_of(file()), "loaded");
    return salvage_map(file());
  };
  const SalvagedMap broken = after("UPDATE submaps SET echoes = x'00' WHERE anchor = 0");
  EXPECT_EQ(broken.map.submaps.submaps.size(), 1U);
  EXPECT_EQ(broken.map.submaps.nodes.size(), 3U);
  EXPECT_THAT(broken.losses.back().what, HasSubstr("submap 0 is damaged: its bytes do not match its checksum"));
  const SalvagedMap lost_node = after("DELETE FROM submap_nodes WHERE number = 2");
  EXPECT_EQ(lost_node.map.submaps.submaps.size(), 1U) << "its anchor is gone";
  EXPECT_EQ(lost_node.map.submaps.edges.size(), 1U);
  const SalvagedMap huge = after("UPDATE submaps SET width = 2147483647, height = 2147483647");
  EXPECT_TRUE(huge.map.submaps.submaps.empty());
  EXPECT_EQ(huge.map.graph, map_with_submaps().graph);
}

TEST_F(MapStore, AMapOfWhichOnlySubmapsAreDamagedCanBeHadWithoutThem) {
  const auto after = [&](const std::string& sql) {
    save_map(file(), map_with_submaps());
    run_sql(file(), sql);
    EXPECT_NE(refusal_of(file()), "loaded");
    return map_without_damaged_submaps(file());
  };
  SavedMap expected = map_with_submaps();
  expected.submaps = {};
  for (const char* const sql : {"UPDATE submaps SET echoes = x'00' WHERE anchor = 0", "DELETE FROM submap_nodes",
                                "UPDATE submap_edges SET xx = 1e308"}) {
    const std::optional<SavedMap> without = after(sql);
    ASSERT_TRUE(without) << sql;
    expect_equal(*without, expected);
  }
  EXPECT_FALSE(after("DELETE FROM submap_nodes; UPDATE landmarks SET x_m = 7")) << "that is worth a repair";
}

TEST_F(MapStore, TheSubmapsOfAMapWithADamagedHeaderAreNotForgotten) {
  save_map(file(), map_with_submaps());
  run_sql(file(), "UPDATE submap_edges SET xx = 7 WHERE number = 1");
  std::string bytes = bytes_of(file());
  bytes[68] ^= '\x40';
  write_bytes(file(), bytes);
  const SalvagedMap salvaged = salvage_map(file());
  EXPECT_EQ(salvaged.version, 2);
  EXPECT_EQ(salvaged.map.submaps.edges.size(), 2U);
}

TEST_F(MapStore, ImpossibleValuesOfSubmapsAreFound) {
  save_map(file(), map_with_submaps());
  run_sql(file(), "UPDATE submap_nodes SET x_m = 1e18 WHERE number = 1; UPDATE submap_edges SET tt = -1");
  std::vector<ValueFinding> findings = check_values(file());
  std::erase_if(findings, [](const ValueFinding& finding) { return !finding.table.starts_with("submap"); });
  ASSERT_EQ(findings.size(), 3U);
  EXPECT_EQ(findings[0].table, "submap_nodes");
  EXPECT_EQ(findings[1].column, "tt");
}

TEST_F(MapStore, EdgesOfThePoseGraphHaveAnInformation) {
  const auto findings_with = [&](const std::string& set) {
    save_map(file(), map_with_submaps());
    run_sql(file(), "UPDATE submap_edges SET " + set + " WHERE to_node = 2");
    std::vector<std::string> all;
    for (const ValueFinding& finding : check_values(file()))
      if (finding.table == "submap_edges") all.push_back(finding.column + " " + finding.what);
    return all;
  };
  EXPECT_THAT(findings_with("xy = 10"), testing::IsEmpty());
  EXPECT_THAT(findings_with("xx = 1e300"), testing::ElementsAre("xx holds 1.0e+300, allowed is 0 to 1e+15"));
  EXPECT_THAT(findings_with("xt = -1e300"), testing::ElementsAre("xt holds -1.0e+300, allowed is -1e+15 to 1e+15"));
  EXPECT_THAT(findings_with("xx = 0, yy = 0, tt = 0, xy = 5"), testing::SizeIs(1));
  EXPECT_THAT(findings_with("xy = 900"),
              testing::ElementsAre("xy is with xt and yt no information: it is not positive semidefinite"));
}

TEST(KeptSubmaps, OnlyTheLatestAreKept) {
  KeptSubmaps submaps;
  constexpr auto kAll = static_cast<std::int64_t>(KeptSubmaps::kMax + 10);
  for (std::int64_t i = 0; i < kAll; ++i) {
    submaps.nodes.push_back({i, 0.0, {}});
    submaps.submaps.push_back(submap_at(i, {}));
    if (i > 0) submaps.edges.push_back({i - 1, i, {}});
  }
  keep_latest(submaps);
  EXPECT_EQ(submaps.submaps.size(), KeptSubmaps::kMax);
  EXPECT_EQ(submaps.nodes.front().number, 10);
  EXPECT_EQ(submaps.submaps.front().anchor, 10);
  EXPECT_EQ(submaps.edges.front().from, 10);
}

TEST(KeptSubmaps, CountEchoesByCell) {
  const KeptSubmap submap = submap_at(0, {{0.05, 0.05}, {0.06, 0.01}, {-0.05, 0.15}, {1e9, 0.0}});
  EXPECT_EQ(submap.min_x, -1);
  EXPECT_EQ(submap.min_y, 0);
  EXPECT_EQ(submap.width, 2);
  EXPECT_EQ(submap.height, 2);
  EXPECT_THAT(submap.echoes, testing::ElementsAre(0, 2, 1, 0));
}

}  // namespace
}  // namespace cairn
