#include "framework/config/config_value.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

using config_test::error_of;
using config_test::TestFolder;
using Kind = ConfigValue::Kind;

ConfigValue example() {
  return parse_config_text("seed: 7\nstart: {at_m: [1, 2]}\nsteps:\n  - explore: {at_most_s: 900}\n  - save: a\nmap:\n",
                           "m.yaml");
}

TEST(SourcePlace, LeavesOutALineThatItDoesNotHave) {
  EXPECT_EQ((SourcePlace{"a.yaml", 3, 7}.text()), "a.yaml:3:7");
  EXPECT_EQ((SourcePlace{"a.yaml", 0, 0}.text()), "a.yaml");
}

TEST(ConfigError, CarriesItsPlaceAndItsSentenceAsData) {
  const ConfigError error({"a.yaml", 3, 7}, "speed_mps must be a number: found \"b.yaml:1:2: x\"");
  EXPECT_EQ(error.place(), (SourcePlace{"a.yaml", 3, 7}));
  EXPECT_EQ(error.sentence(), "speed_mps must be a number: found \"b.yaml:1:2: x\"");
  EXPECT_STREQ(error.what(), "a.yaml:3:7: speed_mps must be a number: found \"b.yaml:1:2: x\"");
}

TEST(ConfigValue, NamesItsKindForPeople) {
  const auto name_of = [](const char* text) { return parse_config_text(text, "m.yaml").find("a")->kind_name(); };
  EXPECT_EQ(name_of("a:"), "nothing");
  EXPECT_EQ(name_of("a: 1.5"), "a number");
  EXPECT_EQ(name_of("a: '1.5'"), "text");
  EXPECT_EQ(name_of("a: true"), "a flag");
  EXPECT_EQ(name_of("a: word"), "text");
  EXPECT_EQ(name_of("a: []"), "a list");
  EXPECT_EQ(name_of("a: {}"), "a map");
}

TEST(Override, ReplacesAValue) {
  ConfigValue root = example();
  apply_override(root, "seed=8");
  EXPECT_EQ(root.find("seed")->scalar, "8");
  EXPECT_EQ(root.find("seed")->place.text(), "--set seed");
  EXPECT_EQ(root.entries.size(), 4U);
}

TEST(Override, ReachesIntoListsAndReadsTheValueAsYaml) {
  ConfigValue root = example();
  apply_override(root, "steps.0.explore.at_most_s=60");
  apply_override(root, "start.at_m.1=2.5");
  apply_override(root, "steps.1={save: 'b = c'}");
  EXPECT_EQ(root.find("steps")->items[0].find("explore")->find("at_most_s")->scalar, "60");
  EXPECT_EQ(root.find("start")->find("at_m")->items[1].scalar, "2.5");
  const ConfigValue& save = *root.find("steps")->items[1].find("save");
  EXPECT_EQ(save.scalar, "b = c");
  EXPECT_EQ(save.place.text(), "--set steps.1");
}

TEST(Override, MakesMapsOnTheWay) {
  ConfigValue root = example();
  apply_override(root, "map.plugin=bayes");
  apply_override(root, "planner.route.plugin=ompl");
  EXPECT_EQ(root.find("map")->find("plugin")->scalar, "bayes");
  EXPECT_EQ(root.find("planner")->find("route")->find("plugin")->scalar, "ompl");
  EXPECT_EQ(root.find("planner")->kind, Kind::map);
}

TEST(Override, AnEmptyValueIsNothing) {
  ConfigValue root = example();
  apply_override(root, "seed=");
  EXPECT_EQ(root.find("seed")->kind, Kind::null);
}

TEST(Override, SaysWhatIsWrong) {
  const auto setting = [](const std::string& text) {
    ConfigValue root = example();
    return error_of([&] { apply_override(root, text); });
  };
  EXPECT_EQ(setting("seed"), "--set: expected KEY=VALUE, found \"seed\"");
  EXPECT_EQ(setting("=3"), "--set: expected KEY=VALUE, found \"=3\"");
  EXPECT_EQ(setting("a..b=3"), "--set a..b: a part of the key is empty");
  ConfigValue root = example();
  EXPECT_EQ(error_of([&] { apply_override(root, "a..b=3", "--clusters"); }),
            "--clusters a..b: a part of the key is empty")
      << "the option that it was given to";
  EXPECT_EQ(setting("seed.x=3"), "--set seed.x: no key \"x\" below the value \"7\" at m.yaml:1:7, which is not a map");
  EXPECT_EQ(setting("steps.2.save=b"),
            "--set steps.2.save: \"2\" is not an item of the list at m.yaml:4:3; allowed: 0 to 1");
  EXPECT_EQ(setting("steps.first=b"),
            "--set steps.first: \"first\" is not an item of the list at m.yaml:4:3; allowed: 0 to 1");
  EXPECT_EQ(setting("seed=[1"), "--set seed:1:1: a key must be text, found a list; is a bracket left open?");
}

TEST(NearestName, FindsSlipsOfTheHand) {
  const std::vector<std::string> names{"radius_m", "polygon_m", "angle_deg", "at_m", "sonars"};
  EXPECT_EQ(nearest_name("radus_m", names), "radius_m");
  EXPECT_EQ(nearest_name("raduis_m", names), "radius_m");
  EXPECT_EQ(nearest_name("SONARS", names), "sonars");
  EXPECT_EQ(nearest_name("angle_rad", names), "angle_deg");
  EXPECT_EQ(nearest_name("colour", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(nearest_name("x", {}), "");
  EXPECT_EQ(nearest_name(std::string(1'000'000, 'a'), names), "");
}

TEST(NearestName, AForgottenUnitIsOneMistake) {
  EXPECT_EQ(nearest_name("angle", {"ankle_x", "angle_deg"}), "angle_deg");
  EXPECT_EQ(nearest_name("at", {"at_m"}), "at_m");
}

TEST(NearestName, TiesGoToTheFirst) {
  EXPECT_EQ(nearest_name("cat", {"bat", "hat"}), "bat");
}

TEST(NearestName, BecomesAQuestion) {
  EXPECT_EQ(did_you_mean("sqare", {"circle", "square"}), " (did you mean \"square\"?)");
  EXPECT_EQ(did_you_mean("desk", {"circle", "square"}), "");
}

TEST(Shown, KeepsMessagesShortAndOnOneLine) {
  EXPECT_EQ(in_quotes("abc"), "\"abc\"");
  EXPECT_EQ(in_quotes("a\nb\x01"), "\"a\\nb\\x01\"");
  EXPECT_EQ(in_quotes(std::string(70, 'x')), "\"" + std::string(60, 'x') + "...\"");
  EXPECT_EQ(in_quotes(std::string(59, 'x') + "\xc3\xa9z"), "\"" + std::string(59, 'x') + "...\"")
      << "no half characters";
}

class Variables : public testing::Test {
 protected:
  ~Variables() override {
    unsetenv("CAIRN_TEST_FOLDER");
    unsetenv("CAIRN_TEST_NONE");
  }
  static std::string resolved(const std::string& text) {
    return resolve_path(*parse_config_text("p: '" + text + "'", "/conf/missions/m.yaml").find("p")).string();
  }
};

TEST_F(Variables, RelativePathsStartAtTheFileThatNamesThem) {
  EXPECT_EQ(resolved("../robots/a.yaml"), "/conf/robots/a.yaml");
  EXPECT_EQ(resolved("a.yaml"), "/conf/missions/a.yaml");
  EXPECT_EQ(resolved("/tmp/a.yaml"), "/tmp/a.yaml");
}

TEST_F(Variables, OverridesStartAtTheCurrentFolder) {
  ConfigValue root;
  apply_override(root, "p=maps/a.cairn");
  EXPECT_EQ(resolve_path(*root.find("p")).string(), "maps/a.cairn");
}

TEST_F(Variables, AreReadFromTheEnvironment) {
  setenv("CAIRN_TEST_FOLDER", "/data", 1);
  EXPECT_EQ(resolved("${CAIRN_TEST_FOLDER}/log.txt"), "/data/log.txt");
  EXPECT_EQ(resolved("${CAIRN_TEST_FOLDER:-elsewhere}/log.txt"), "/data/log.txt");
  EXPECT_EQ(resolved("${CAIRN_TEST_NONE:-../../shared}/log.txt"), "/shared/log.txt");
  EXPECT_EQ(resolved("${CAIRN_TEST_NONE:-}log.txt"), "/conf/missions/log.txt");
  setenv("CAIRN_TEST_FOLDER", "", 1);
  EXPECT_EQ(resolved("${CAIRN_TEST_FOLDER:-/other}/log.txt"), "/other/log.txt")
      << "empty counts as unset, as in a shell";
  EXPECT_EQ(resolved("$5/{a}"), "/conf/missions/$5/{a}") << "only ${ begins a variable";
}

TEST_F(Variables, SayWhatIsWrong) {
  const auto error = [](const std::string& text) { return error_of([&] { (void)resolved(text); }); };
  EXPECT_EQ(error("${CAIRN_TEST_NONE}/a"),
            "/conf/missions/m.yaml:1:4: the environment variable CAIRN_TEST_NONE is not set and ${CAIRN_TEST_NONE} has "
            "no default; set it or write ${CAIRN_TEST_NONE:-default}");
  EXPECT_EQ(error("${CAIRN_TEST_NONE/a"), "/conf/missions/m.yaml:1:4: \"${\" without \"}\" in \"${CAIRN_TEST_NONE/a\"");
  EXPECT_EQ(error("${}"), "/conf/missions/m.yaml:1:4: \"${}\" is not a variable; allowed: ${NAME} or ${NAME:-default}");
  EXPECT_EQ(error("${A:-${B}}"),
            "/conf/missions/m.yaml:1:4: a variable within a variable in \"${A:-${B}}\" is not supported");
  EXPECT_EQ(error(""), "/conf/missions/m.yaml:1:4: expected a path, found an empty text");
  EXPECT_EQ(error_of([] { (void)resolve_path(parse_config_text("[1]", "m.yaml")); }),
            "m.yaml:1:1: expected a path, found a list");
}

TEST_F(Variables, FolderLinksKeepTheirMeaning) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.path() / "real" / "inner");
  (void)folder.write("real/a.yaml", "");
  std::filesystem::create_directory_symlink(folder.path() / "real" / "inner", folder.path() / "link");
  ConfigValue value;
  value.kind = Kind::scalar;
  value.scalar = "link/../a.yaml";
  value.place = {(folder.path() / "m.yaml").string(), 1, 1};
  EXPECT_TRUE(std::filesystem::exists(resolve_path(value))) << "real/a.yaml, not a.yaml beside the link";
}

}  // namespace
}  // namespace cairn
