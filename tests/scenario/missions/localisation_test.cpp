// Does what is seen again hold the pose? The worn robot in the office, with and without corrections.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

constexpr int kSeeds = 3;

struct Errors {
  double mean_median_m = 0.0;
  double worst_m = 0.0;
};

Errors run_patrols(const std::string& name, const std::vector<std::string>& settings) {
  Errors errors;
  for (int seed = 301; seed < 301 + kSeeds; ++seed) {
    const auto folder = fresh_folder(name + std::to_string(seed));
    std::vector<std::string> arguments{"run",    source_folder() + "/config/missions/patrol_hour.yaml",
                                       "--out",  folder.string(),
                                       "--seed", std::to_string(seed),
                                       "--set",  "at_most_s=480",
                                       "--json"};
    for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
    const Finished finished = run_cairn(arguments);
    const auto error = nlohmann::json::parse(finished.out)["pose_error"];
    errors.mean_median_m += error["median_m"].get<double>() / kSeeds;
    errors.worst_m = std::max(errors.worst_m, error["worst_m"].get<double>());
    const auto report = nlohmann::json::parse(text_of_file(folder / "report.json"));
    double worst_m = 0.0;
    for (const auto& sample : report["pose_errors"]) worst_m = std::max(worst_m, sample["error_m"].get<double>());
    EXPECT_EQ(worst_m, error["worst_m"].get<double>()) << "of the samples beside it";
  }
  return errors;
}

TEST(Localisation, HoldsBetterWithWhatIsSeenAgain) {
  const Errors with = run_patrols("localisation_with", {});
  const Errors without =
      run_patrols("localisation_without", {"localizer.use_landmarks=false", "localizer.use_walls=false"});
  EXPECT_LT(with.mean_median_m, 0.8 * without.mean_median_m)
      << "with " << with.mean_median_m << " m, without " << without.mean_median_m << " m";
}

}  // namespace
}  // namespace cairn::testing_program
