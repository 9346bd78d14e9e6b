// Import, export, import: what a recorded map holds comes back cell by cell.

#include <gtest/gtest.h>

#include "framework/files/map_server_file.hpp"
#include "maps/base/source_text.hpp"
#include "maps/exchange/grids/grey_picture_write.hpp"
#include "maps/exchange/grids/map_server_write.hpp"
#include "tests/framework/config/config_test_support.hpp"
#include "tests/framework/files/recorded_maps.hpp"

namespace cairn {
namespace {

using config_test::TestFolder;

OccupancyGrid written_and_read(const OccupancyGrid& grid, MapServerMode mode, PictureFormat format) {
  const TestFolder folder;
  const ExportedGrid exported = map_server_of(grid, mode);
  static_cast<void>(folder.write("map.picture", picture_text_of(exported.picture, format)));
  return load_map_server(folder.write("map.yaml", map_server_yaml_of(exported.settings, "map.picture"))).grid;
}

void expect_round_trip(const OccupancyGrid& grid, MapServerMode mode, const std::string& what) {
  for (const PictureFormat format : {PictureFormat::pgm, PictureFormat::png, PictureFormat::bmp})
    if (mode != MapServerMode::scale || format != PictureFormat::pgm) {
      EXPECT_TRUE(written_and_read(grid, mode, format) == grid)
          << what << " mode " << static_cast<int>(mode) << " format " << static_cast<int>(format);
    }
}

// 205, transparency, what lies at the thresholds.
OccupancyGrid drawn(const std::string& yaml) {
  const TestFolder folder;
  const GreyPicture picture{4,
                            3,
                            {0, 205, 254, 90, 89, 206, 255, 0, 254, 205, 100, 0},
                            {255, 255, 255, 255, 255, 255, 255, 9, 0, 255, 255, 255}};
  static_cast<void>(folder.write("m.png", picture_text_of(picture, PictureFormat::png)));
  return load_map_server(folder.write("m.yaml", yaml)).grid;
}

TEST(MapServerRoundTrip, OfDrawnMapsWithEveryTrap) {
  for (const char* const origin : {"[0.1, -7.25, 0]", "[1, 2, 0.5]"})
    for (const char* const negate : {"0", "1"})
      for (const char* const mode : {"trinary", "raw"}) {
        const std::string yaml = std::string("image: m.png\nresolution: 0.0123\norigin: ") + origin +
                                 "\nnegate: " + negate + "\nmode: " + mode +
                                 "\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
        const OccupancyGrid grid = drawn(yaml);
        expect_round_trip(grid, MapServerMode::raw, yaml);
        expect_round_trip(grid, MapServerMode::scale, yaml);
        // Percents have no place in trinary.
        if (std::string(mode) == "trinary") expect_round_trip(grid, MapServerMode::trinary, yaml);
      }
}

TEST(MapServerRoundTrip, OfAllRecordedMaps) {
  const std::filesystem::path data = config_test::recorded_maps();
  if (!std::filesystem::exists(data / "nav2/depot.yaml"))
    GTEST_SKIP() << "needs occ_maps of the data folder (CAIRN_DATA)";
  int maps = 0;
  for (const std::filesystem::path& yaml : config_test::map_server_files(data)) {
    const OccupancyGrid grid = [&] {
      const TestFolder folder;
      return load_map_server(config_test::unpacked_map(yaml, folder)).grid;
    }();
    for (const MapServerMode mode : {MapServerMode::trinary, MapServerMode::scale, MapServerMode::raw})
      expect_round_trip(grid, mode, yaml.string());
    ++maps;
  }
  EXPECT_EQ(maps, 10);
}

// Floor plans that came without a YAML file.
TEST(MapServerRoundTrip, OfAllFloorPlans) {
  const std::filesystem::path plans = config_test::recorded_maps() / "ipa_rooms";
  if (!std::filesystem::exists(plans)) GTEST_SKIP() << "needs occ_maps/ipa_rooms of the data folder (CAIRN_DATA)";
  const TestFolder folder;
  int pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(plans)) {
    if (entry.path().extension() != ".png") continue;
    const std::string yaml = "image: " + entry.path().string() +
                             "\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
                             "free_thresh: 0.196\n";
    const OccupancyGrid grid = load_map_server(folder.write("plan.yaml", yaml), PictureFolder::any).grid;
    for (const MapServerMode mode : {MapServerMode::trinary, MapServerMode::raw})
      EXPECT_TRUE(written_and_read(grid, mode, PictureFormat::pgm) == grid) << entry.path();
    ++pictures;
  }
  EXPECT_GE(pictures, 30);
}

}  // namespace
}  // namespace cairn
