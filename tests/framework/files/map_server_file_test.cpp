#include "framework/files/map_server_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "maps/base/source_text.hpp"
#include "tests/framework/config/config_test_support.hpp"
#include "tests/framework/files/recorded_maps.hpp"

namespace cairn {
namespace {

using config_test::error_of;
using config_test::TestFolder;

// A whole file, key by key, so that a test changes one of them.
struct Keys {
  std::map<std::string, std::string> of{{"image", "map.pgm"}, {"resolution", "0.05"},      {"origin", "[1.5, -2, 0.0]"},
                                        {"negate", "0"},      {"occupied_thresh", "0.65"}, {"free_thresh", "0.196"}};
  [[nodiscard]] Keys with(const std::string& key, const std::string& value) const {
    Keys keys = *this;
    keys.of[key] = value;
    return keys;
  }
  [[nodiscard]] Keys without(const std::string& key) const {
    Keys keys = *this;
    keys.of.erase(key);
    return keys;
  }
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const auto& [key, value] : of) text += key + ": " + value + "\n";
    return text;
  }
};

MapServerFile parse(const Keys& keys) {
  return parse_map_server_yaml(keys.text(), "folder/map.yaml");
}
std::string refusal(const Keys& keys) {
  return error_of([&] { static_cast<void>(parse(keys)); });
}

TEST(MapServerFile, KeysAreReadAndThePictureLiesBesideTheFile) {
  const MapServerFile file = parse(Keys{}.with("mode", "scale").with("negate", "true"));
  EXPECT_EQ(file.picture, "folder/map.pgm");
  EXPECT_EQ(parse(Keys{}.with("image", "/data/map.png")).picture, "/data/map.png");
  EXPECT_EQ(file.settings.mode, MapServerMode::scale);
  EXPECT_EQ(file.settings.resolution_m, 0.05);
  EXPECT_EQ(file.settings.origin, (Pose2{1.5, -2.0, 0.0}));
  EXPECT_TRUE(file.settings.negate);
  EXPECT_EQ(file.settings.occupied_thresh, 0.65);
  EXPECT_EQ(file.settings.free_thresh, 0.196);
  EXPECT_EQ(parse({}).settings.mode, MapServerMode::trinary);
  EXPECT_FALSE(parse({}).settings.negate);
}

TEST(MapServerFile, EveryKeyButTheModeIsNeeded) {
  for (const auto& [key, value] : Keys{}.of)
    EXPECT_TRUE(
        refusal(Keys{}.without(key)).starts_with("folder/map.yaml:1:1: the map lacks the key \"" + key + "\": "))
        << refusal(Keys{}.without(key));
}

TEST(MapServerFile, WrongValuesAreRefusedWithTheirPlace) {
  EXPECT_EQ(refusal(Keys{}.with("resolutoin", "1")),
            "folder/map.yaml:7:1: unknown key \"resolutoin\" in the map (did you mean \"resolution\"?); known: image, "
            "resolution, origin, negate, occupied_thresh, free_thresh, mode");
  EXPECT_EQ(refusal(Keys{}.with("resolution", "0")),
            "folder/map.yaml:6:13: resolution must be a number from 0.001 to 1000 m, found \"0\"");
  EXPECT_EQ(refusal(Keys{}.with("occupied_thresh", "65")),
            "folder/map.yaml:4:18: occupied_thresh must be a number from 0 to 1, found \"65\"");
  EXPECT_EQ(refusal(Keys{}.with("free_thresh", "0.7")),
            "folder/map.yaml:1:14: free_thresh must not be above occupied_thresh, found 0.7 and 0.65");
  EXPECT_EQ(refusal(Keys{}.with("origin", "[0, 0]")),
            "folder/map.yaml:5:9: origin must be [x, y, yaw], found a list of 2");
  EXPECT_EQ(refusal(Keys{}.with("origin", "[0, .nan, 0]")).substr(0, 21), "folder/map.yaml:5:13:");
  EXPECT_EQ(refusal(Keys{}.with("negate", "2")),
            "folder/map.yaml:3:9: negate must be 0, 1, true or false, found \"2\"");
  EXPECT_EQ(refusal(Keys{}.with("mode", "scaled")),
            "folder/map.yaml:3:7: mode must be one of trinary, scale, raw, found \"scaled\" (did you mean \"scale\"?)");
  EXPECT_EQ(refusal(Keys{}.with("image", "\"\"")), "folder/map.yaml:2:8: expected a path, found an empty text");
}

TEST(MapServerFile, ReportsWhenTheResolutionMayHaveBeenRounded) {
  EXPECT_EQ(parse(Keys{}.with("resolution", "0.013")).warnings,
            std::vector<std::string>{"folder/map.yaml:6:13: resolution 0.013: map_server saves three decimals only, "
                                     "so it may be up to 3.8 % off"});
  for (const char* resolution : {"0.025", "0.050", "0.05", "1", "0.0125"})
    EXPECT_TRUE(parse(Keys{}.with("resolution", resolution)).warnings.empty()) << resolution;
}

TEST(MapServerFile, TheGridIsWhatThePictureShows) {
  const TestFolder folder;
  static_cast<void>(folder.write("map.pgm", "P2 3 2 255\n0 205 254\n254 254 0\n"));
  const ImportedGrid imported = load_map_server(folder.write("map.yaml", Keys{}.text()));
  EXPECT_EQ(imported.grid.state(imported.grid.cell_at({1.525, -1.925})), CellState::occupied);
  EXPECT_EQ(imported.grid.state(imported.grid.cell_at({1.575, -1.925})), CellState::unknown);
  EXPECT_EQ(imported.grid.state(imported.grid.cell_at({1.625, -1.925})), CellState::free);
  EXPECT_EQ(imported.grid.state(imported.grid.cell_at({1.625, -1.975})), CellState::occupied);
}

TEST(MapServerFile, APictureThatIsNotThereIsRefusedWhereItIsNamed) {
  const TestFolder folder;
  const std::filesystem::path yaml = folder.write("b.yaml", Keys{}.with("image", "none.pgm").text());
  try {
    static_cast<void>(load_map_server(yaml));
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::MatchesRegex(yaml.string() + ":[0-9]+:8: image: " +
                                                    (folder.path() / "none.pgm").string() + ": no such file"));
  }
}

TEST(MapServerFile, APictureOutsideTheFolderIsReadOnlyWhenThatIsAllowed) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.path() / "maps" / "pictures");
  static_cast<void>(folder.write("map.pgm", "P2 1 1 255\n0\n"));
  static_cast<void>(folder.write("maps/pictures/map.pgm", "P2 2 1 255\n0 0\n"));
  const auto yaml_of = [&](const std::string& image) {
    return folder.write("maps/m.yaml", Keys{}.with("image", image).text());
  };
  std::filesystem::create_symlink("../map.pgm", folder.path() / "maps/out.pgm");
  std::filesystem::create_symlink("pictures/map.pgm", folder.path() / "maps/in.pgm");
  for (const std::string& image :
       {std::string("../map.pgm"), std::string("out.pgm"), std::string("pictures/../../map.pgm"),
        (folder.path() / "map.pgm").string(), std::string("/etc/passwd")}) {
    const std::filesystem::path yaml = yaml_of(image);
    try {
      static_cast<void>(load_map_server(yaml));
      ADD_FAILURE() << image;
    } catch (const ConfigError& error) {
      EXPECT_THAT(error.what(),
                  testing::MatchesRegex(yaml.string() + ":[0-9]+:8: image: .* is outside the folder of "
                                                        "the map; --allow-outside reads it all the same"));
    }
  }
  EXPECT_EQ(load_map_server(yaml_of("../map.pgm"), PictureFolder::any).grid.bounds().width(), 1);
  for (const std::string& image :
       {std::string("pictures/map.pgm"), std::string("in.pgm"), std::string("./pictures/../pictures/map.pgm"),
        (folder.path() / "maps/pictures/map.pgm").string()})
    EXPECT_EQ(load_map_server(yaml_of(image)).grid.bounds().width(), 2) << image;
}

TEST(MapServerFile, RecordedMapsAreRead) {
  const std::filesystem::path data = config_test::recorded_maps();
  if (!std::filesystem::exists(data / "nav2/depot.yaml"))
    GTEST_SKIP() << "needs occ_maps of the data folder (CAIRN_DATA)";
  struct Expected {
    const char* file;
    CellBox cells;
    double cell_m;
    std::size_t warnings;
  };
  for (const Expected& expected : {Expected{"nav2/depot", {{0, 0}, {604, 307}}, 0.05, 1},
                                   Expected{"nav2/tb3_sandbox", {{0, 0}, {384, 384}}, 0.05, 0},
                                   Expected{"patrolling_sim/cumberland/cumberland", {{0, 0}, {688, 499}}, 0.075, 0}}) {
    const TestFolder folder;
    const ImportedGrid imported =
        load_map_server(config_test::unpacked_map((data / expected.file).string() + ".yaml", folder));
    EXPECT_EQ(imported.grid.bounds(), expected.cells) << expected.file;
    EXPECT_EQ(imported.grid.cell_m(), expected.cell_m);
    EXPECT_EQ(imported.warnings.size(), expected.warnings);
    EXPECT_GT(known_ratio(imported.grid), 0.5);
    EXPECT_LT(known_ratio(imported.grid), expected.warnings > 0 ? 1.1 : 1.0);
  }
}

}  // namespace
}  // namespace cairn
