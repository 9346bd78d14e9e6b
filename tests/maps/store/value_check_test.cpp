#include "maps/store/value_check.hpp"

#include "tests/maps/store/store_fixture.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::IsEmpty;

class ValueCheck : public MapStore {
 protected:
  // A map with rows in every table, and nothing that cannot be true.
  static SavedMap good_map() {
    SavedMap map = map_with_trajectories();
    map.driven_path = {{0, 0, 0}, {0.1, 0.2, 0.3}};
    return map;
  }
  [[nodiscard]] std::vector<std::string> findings() const {
    std::vector<std::string> all;
    for (const ValueFinding& finding : check_values(file()))
      all.push_back(finding.table + " " + finding.row + " " + finding.column + " " + finding.what);
    return all;
  }
  [[nodiscard]] std::vector<std::string> findings_after(const std::string& sql) const {
    static const std::string bytes = [this] {
      save_map(file(), good_map());
      return bytes_of(file());
    }();
    write_bytes(file(), bytes);
    run_sql(file(), sql);
    return findings();
  }
};

TEST_F(ValueCheck, WhatCairnWritesIsSound) {
  for (const SavedMap& map : {SavedMap{}, good_map()}) {
    save_map(file(), map);
    EXPECT_THAT(findings(), IsEmpty());
  }
}

TEST_F(ValueCheck, APlaceFarFromTheMapIsFound) {
  EXPECT_THAT(findings_after("UPDATE landmarks SET x_m = 1e18 WHERE id = 1"),
              ElementsAre("landmarks 1 x_m holds 1.0e+18, allowed is -1000001.25 to 999998.75"));
  EXPECT_THAT(findings_after("UPDATE driven_path SET y_m = -2e6 WHERE number = 2"),
              ElementsAre("driven_path 2 y_m holds -2000000.0, allowed is -999999.9 to 1000000.1"));
  EXPECT_THAT(findings_after("UPDATE progress SET true_x_m = 9e999"),
              ElementsAre("progress 0 true_x_m holds Inf, allowed is -1000001.25 to 999998.75"));
  EXPECT_THAT(findings_after("UPDATE candidates SET access_x_m = 1e7"), testing::SizeIs(1));
}

TEST_F(ValueCheck, AMapWithoutCellsMayHaveThePlacesOfAGraphFile) {
  SavedMap map;
  Landmark far;
  far.T_map_landmark = {5e5, 5.4e6, 0.0};
  map.graph.add(far);
  save_map(file(), map);
  EXPECT_THAT(findings(), IsEmpty());
  run_sql(file(), "UPDATE landmarks SET y_m = 1e18");
  EXPECT_THAT(findings(), ElementsAre("landmarks 1 y_m holds 1.0e+18, allowed is -1e+09 to 1e+09"));
}

TEST_F(ValueCheck, APoseOfATrajectoryFarFromTheMapIsFound) {
  SavedMap map = good_map();
  const RouteId id = map.graph.add_route({0, 4, 1, 9.0, {{0.1, 0.2, 0.0}, {3e6, 0.0, 0.0}}, true, false, 0});
  save_map(file(), map);
  EXPECT_THAT(findings(), ElementsAre("routes " + std::to_string(id) +
                                      " trajectory holds pose 2 at (3e+06, 0) m, too far from the map"));
}

TEST_F(ValueCheck, CostsAreFiniteAndNotNegative) {
  EXPECT_THAT(findings_after("UPDATE routes SET cost_m = -1.5 WHERE id = (SELECT max(id) FROM routes)"),
              ElementsAre(EndsWith(" cost_m holds -1.5, allowed is 0 or more, and finite")));
  EXPECT_THAT(findings_after("UPDATE routes SET cost_m = 9e999 WHERE id = (SELECT max(id) FROM routes)"),
              ElementsAre(EndsWith(" cost_m holds Inf, allowed is 0 or more, and finite")));
}

TEST_F(ValueCheck, DegreesAreSharesOfOne) {
  EXPECT_THAT(findings_after("UPDATE landmarks SET degree = 1.5 WHERE id = 1"),
              ElementsAre("landmarks 1 degree holds 1.5, allowed is 0 to 1"));
  EXPECT_THAT(findings_after("UPDATE landmark_templates SET degree = -0.1 WHERE rank = 2"),
              ElementsAre("landmark_templates 1 degree holds -0.1, allowed is 0 to 1"));
  EXPECT_THAT(findings_after("UPDATE candidate_evidence SET best_degree = 2.0"), testing::SizeIs(1));
}

TEST_F(ValueCheck, SizesCountsAndTimesHaveLimits) {
  EXPECT_THAT(findings_after("UPDATE grid SET cell_m = 1e6"),
              ElementsAre("grid 0 cell_m holds 1000000.0, allowed is 1e-06 to 1000"));
  EXPECT_THAT(findings_after("UPDATE shapes SET parameters = '1e9' WHERE kind = 'circle'"),
              ElementsAre("shapes 2 parameters holds \"1e9\", allowed is -1000 to 1000"));
  EXPECT_THAT(findings_after("UPDATE progress SET time_s = -3.0"),
              ElementsAre("progress 0 time_s holds -3.0, allowed is 0 to 1e+09"));
  EXPECT_THAT(findings_after("INSERT INTO meta VALUES ('paused_s', '-2')"),
              ElementsAre("meta paused_s value holds \"-2\", allowed is 0 to 1e+09"));
  EXPECT_THAT(findings_after("UPDATE landmarks SET sightings = -1 WHERE id = 1"), testing::SizeIs(1));
}

TEST_F(ValueCheck, IdsFitADouble) {
  EXPECT_THAT(findings_after("UPDATE landmark_evidence SET landmark = 9007199254740993;"
                             "UPDATE candidate_evidence SET landmark = 9007199254740993"),
              ElementsAre("candidate_evidence 9007199254740993 landmark holds 9007199254740993, allowed is 1 to "
                          "9007199254740991"));
}

TEST_F(ValueCheck, ARobotHasARadius) {
  const std::string set = "INSERT OR REPLACE INTO meta (key, value) VALUES ('robot_radius_m', '";
  EXPECT_THAT(findings_after(set + "0.22')"), IsEmpty());
  for (const std::string radius : {"-5", "1e300", "nan"})
    EXPECT_THAT(findings_after(set + radius + "')"),
                ElementsAre("meta robot_radius_m value holds \"" + radius + "\", allowed is 0 to 10"));
}

TEST_F(ValueCheck, NamesHoldNoControlCharacters) {
  EXPECT_THAT(findings_after("UPDATE landmarks SET name = 'a' || char(10) || 'b' WHERE id = 1"),
              ElementsAre("landmarks 1 name holds the control character \\x0a"));
  EXPECT_THAT(
      findings_after("UPDATE candidate_evidence SET category = 'a' || char(9)"),
      testing::AllOf(testing::Not(IsEmpty()), testing::Each(EndsWith(" category holds the control character \\x09"))));
}

TEST_F(ValueCheck, ATextInPlaceOfANumberIsFoundAndPrintable) {
  EXPECT_THAT(findings_after("UPDATE landmarks SET degree = 'x' || char(27) WHERE id = 1"),
              ElementsAre("landmarks 1 degree holds x\\x1b, allowed is 0 to 1"));
}

TEST_F(ValueCheck, AViewInPlaceOfATableIsNotAsked) {
  EXPECT_THAT(findings_after("DROP TABLE landmarks; CREATE VIEW landmarks AS WITH RECURSIVE n(id) AS (SELECT 1 UNION "
                             "ALL SELECT id + 1 FROM n) SELECT * FROM n"),
              IsEmpty());
  write_bytes(file(), "no map");
  EXPECT_THROW((void)check_values(file()), StoreError);
}

}  // namespace
}  // namespace cairn
