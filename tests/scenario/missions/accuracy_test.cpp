// A guard on what Cairn is for: a change that spoils recognition fails here, long before the experiments of
// docs/results are run again. The seeds are not those on which anything was tuned or published.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

nlohmann::json rows_of(const std::string& name, const std::string& experiment) {
  const auto folder = fresh_folder(name);
  write_text(folder / "experiment.yaml", experiment);
  const Finished finished =
      run_cairn({"experiment", (folder / "experiment.yaml").string(), "--out", (folder / "out").string(), "--json"});
  EXPECT_LE(finished.exit_status, 1) << finished.err;
  return nlohmann::json::parse(finished.out)["rows"];
}

TEST(Accuracy, TenRandomWorldsAreRecognised) {
  const auto rows = rows_of("accuracy_worlds", "experiment: recognition\nmissions: [" + source_folder() +
                                                   "/config/missions/recognition.yaml]\n"
                                                   "seeds: {from: 5001, count: 10}\ntolerance_m: 0.3\n"
                                                   "worlds: {min_landmarks: 1, max_landmarks: 6, max_distractors: 2, "
                                                   "size_tolerance_ratio: 0.1, gap_m: 1.2}\n"
                                                   "variants:\n  - {name: pioneer1}\n");
  ASSERT_EQ(rows.size(), 10U);
  double found = 0.0;
  double missed = 0.0;
  double wrong = 0.0;
  for (const auto& row : rows) {
    EXPECT_EQ(row["outcome"], "done") << row["reason"];
    found += row["found"].get<double>();
    missed += row["missed"].get<double>();
    wrong += row["false"].get<double>();
  }
  EXPECT_GT(found, 20.0);
  EXPECT_GE(found / (found + missed), 0.93) << "recall";
  EXPECT_GE(found / (found + wrong), 0.93) << "precision";
}

TEST(Accuracy, TheTrueCategoryWinsAtTheEndOfEachOrbitOfTable1) {
  const auto rows = rows_of(
      "accuracy_table1",
      "experiment: places\nmissions: [" + source_folder() +
          "/config/missions/table1.yaml]\nseeds: {from: 5001, count: 3}\ncategories: [circle, triangle, square]\n"
          "places:\n  - {name: P1, looks_at: square}\n  - {name: P2, looks_at: square}\n"
          "  - {name: P3, looks_at: square}\n  - {name: P4, looks_at: circle}\n  - {name: P5, looks_at: circle}\n"
          "  - {name: P6, looks_at: circle}\n  - {name: P7, looks_at: triangle}\n  - {name: P8, looks_at: triangle}\n"
          "  - {name: P9, looks_at: triangle}\nvariants:\n  - {name: sensed}\n");
  ASSERT_EQ(rows.size(), 3U);
  for (const auto& row : rows)
    for (const std::size_t last : {2U, 5U, 8U}) {
      const auto& place = row["places"].at(last);
      const std::string is = place["looks_at"];
      for (const char* other : {"circle", "triangle", "square"})
        if (other != is) {
          EXPECT_GT(place[is].get<double>(), place[other].get<double>() + 0.05) << row["seed"] << place;
        }
    }
}

}  // namespace
}  // namespace cairn::testing_program
