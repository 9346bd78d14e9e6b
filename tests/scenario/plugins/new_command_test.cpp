// `cairn plugins new`: what it writes, and what it refuses. That the projects build is tests/consumer's.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class PluginsNew : public testing::Test {
 protected:
  Finished make(const std::string& kind, const std::string& name) {
    return run_cairn({"plugins", "new", kind, name, "--folder", project_.string(), "--json"});
  }
  void expect_refused(const Finished& finished, const std::string& sentence) {
    EXPECT_EQ(finished.exit_status, 2);
    EXPECT_THAT(finished.err, HasSubstr(sentence));
    EXPECT_FALSE(std::filesystem::exists(project_)) << "a refusal writes nothing";
  }

  const std::filesystem::path project_ = fresh_folder("plugins_new") / "project";
};

TEST_F(PluginsNew, WritesAWholeProjectOfEveryKindWithoutAnyMarkLeft) {
  for (const std::string kind : {"sensor", "localizer", "loop_closer", "map", "detector", "marker_detector", "planner",
                                 "path_planner", "route_planner", "controller", "behaviour"}) {
    std::filesystem::remove_all(project_);
    const Finished finished = make(kind, "my_" + kind);
    ASSERT_EQ(finished.exit_status, 0) << finished.err;
    const auto files = nlohmann::json::parse(finished.out).at("files").get<std::vector<std::string>>();
    EXPECT_THAT(files, IsSupersetOf({std::string("CMakeLists.txt"), std::string("README.md"), std::string("module.cpp"),
                                     std::string("mission.yaml"), "my_" + kind + "_test.cpp"}));
    for (const std::string& file : files) EXPECT_THAT(text_of_file(project_ / file), Not(HasSubstr("@"))) << file;
    EXPECT_THAT(text_of_file(project_ / "module.cpp"), HasSubstr("\"my_" + kind + "\""));
  }
}

// The scaffold's own controller needs a build; a shipped one shows that the mission asks for the avoidance of
// obstacles.
TEST_F(PluginsNew, TheMissionOfAControllerHasSomethingInTheWay) {
  ASSERT_EQ(make("controller", "my_controller").exit_status, 0);
  const Finished finished = run_cairn({"run", (project_ / "mission.yaml").string(), "--set",
                                       "controller.plugin=plain_pursuit", "--out", (project_ / "out").string()});
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("waits: blocked at"));
}

TEST_F(PluginsNew, AnUnknownKindNamesTheNearest) {
  expect_refused(make("detektor", "my_detector"), "no kind of module \"detektor\" (did you mean \"detector\"?)");
}

TEST_F(PluginsNew, ANameThatIsNoIdentifierIsRefused) {
  for (const char* name : {"MyDetector", "my-detector", "2nd", "_x", "x_", "a__b", "", "../up", "test"})
    expect_refused(make("detector", name), "is not a name for a module");
}

TEST_F(PluginsNew, ANameThatAModuleBearsAlreadyIsRefused) {
  expect_refused(make("behaviour", "explore"), "there is a module \"explore\" already");
}

TEST_F(PluginsNew, AFolderThatIsThereIsLeftAsItIs) {
  std::filesystem::create_directories(project_);
  const Finished finished = make("map", "my_map");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("is there already"));
  EXPECT_TRUE(std::filesystem::is_empty(project_));
}

}  // namespace
}  // namespace cairn::testing_program
