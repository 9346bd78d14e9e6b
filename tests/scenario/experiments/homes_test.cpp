// A home of three rooms with doors of 0.8 m, explored whole.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;

TEST(Homes, OneWithDoorsOfEightyCentimetresIsEnteredWhole) {
  const std::filesystem::path folder = fresh_folder("homes");
  const std::filesystem::path file = folder / "homes.yaml";
  std::ofstream(file) << "experiment: homes\n"
                         "missions: ["
                      << source_folder() << "/config/missions/homes.yaml]\n"
                      << "seeds: {from: 5, count: 1}\n"
                         "at_least_ratio: 0.95\n"
                         "homes: {min_rooms: 3, max_rooms: 3, min_area_m2: 40, max_area_m2: 45, min_door_m: 0.8, "
                         "max_door_m: 0.8}\n"
                         "variants:\n  - {name: ring8, robot: "
                      << source_folder() << "/config/robots/ring8.yaml}\n";
  const Finished run = run_cairn({"experiment", file.string(), "--out", (folder / "out").string(), "--json"});
  ASSERT_EQ(run.exit_status, 0) << run.err;
  const json home = json::parse(run.out)["runs"][0]["home"];
  EXPECT_EQ(home["rooms"], 3) << home;
  EXPECT_EQ(home["entered"], 3) << home;
  EXPECT_GE(home["known_ratio"], 0.95) << home;
  EXPECT_EQ(home["fast_contacts"], 0) << home;
  EXPECT_TRUE(home["success"]) << home;
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "seed_5" / "map.png")) << "drawn over the true walls";
}

}  // namespace
}  // namespace cairn::testing_program
