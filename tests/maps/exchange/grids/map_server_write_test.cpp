#include "maps/exchange/grids/map_server_write.hpp"

#include <gtest/gtest.h>

#include <random>

#include "maps/base/yaml_text.hpp"
#include "maps/exchange/grids/grey_picture_write.hpp"

namespace cairn {
namespace {

constexpr MapServerMode kModes[]{MapServerMode::trinary, MapServerMode::scale, MapServerMode::raw};
constexpr PictureFormat kFormats[]{PictureFormat::pgm, PictureFormat::png, PictureFormat::bmp};

// Of odd size, far from the lattice's zero, each cell as `value` says.
template <class Value>
OccupancyGrid grid_with(Value value, double cell_m = 0.0125) {
  OccupancyGrid grid(cell_m, 4.0, {-3.3, 1.0 / 3.0});
  const CellBox box{{-17, 5}, {20, 36}};
  grid.include(box);
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) grid.set_log_odds({x, y}, value());
  return grid;
}

ImportedGrid read_back(const ExportedGrid& exported, PictureFormat format) {
  return grid_of(parse_grey_picture(picture_text_of(exported.picture, format), "p"), exported.settings, "p");
}

// The first cell that differs by more than `most`, by places on the plane; empty: none.
std::string difference(const OccupancyGrid& a, const OccupancyGrid& b, int most = 0) {
  if (a.bounds().width() != b.bounds().width() || a.bounds().height() != b.bounds().height()) return "another size";
  const Cell shift = b.bounds().min - a.bounds().min;
  for (int y = a.bounds().min.y; y < a.bounds().max.y; ++y)
    for (int x = a.bounds().min.x; x < a.bounds().max.x; ++x) {
      const Cell there = Cell{x, y} + shift;
      if ((a.centre_of({x, y}) - b.centre_of(there)).norm() > 1e-12) return "another place";
      if (std::abs(a.log_odds({x, y}) - b.log_odds(there)) > most)
        return "cell " + std::to_string(x) + "," + std::to_string(y) + ": " + std::to_string(a.log_odds({x, y})) +
               " became " + std::to_string(b.log_odds(there));
    }
  return "";
}

TEST(MapServerWrite, FreeOccupiedAndUnknownComeBackInEveryModeAndFormat) {
  std::mt19937 random(1);
  const OccupancyGrid grid =
      grid_with([&] { return static_cast<LogOdds>(1024 * (static_cast<int>(random() % 3) - 1)); });
  for (const MapServerMode mode : kModes)
    for (const PictureFormat format : kFormats) {
      const ExportedGrid exported = map_server_of(grid, mode);
      EXPECT_EQ(difference(grid, read_back(exported, format).grid), "")
          << static_cast<int>(mode) << " " << static_cast<int>(format);
      EXPECT_TRUE(exported.warnings.empty());
    }
}

TEST(MapServerWrite, EveryPercentComesBackInRawAndScale) {
  OccupancyGrid grid(0.05);
  for (int percent = 0; percent <= 100; ++percent) grid.set_log_odds({percent, 0}, log_odds_of(percent / 100.0));
  for (const MapServerMode mode : {MapServerMode::raw, MapServerMode::scale})
    EXPECT_EQ(difference(grid, read_back(map_server_of(grid, mode), PictureFormat::png).grid), "");
}

TEST(MapServerWrite, AnyLogOddsComeBackWithinHalfAPercentAndThenStay) {
  std::mt19937 random(2);
  const OccupancyGrid grid = grid_with([&] { return static_cast<LogOdds>(static_cast<int>(random() % 2049) - 1024); });
  for (const MapServerMode mode : {MapServerMode::raw, MapServerMode::scale}) {
    const OccupancyGrid once = read_back(map_server_of(grid, mode), PictureFormat::png).grid;
    const CellBox box = once.bounds();
    for (int y = 0; y < box.max.y; ++y)
      for (int x = 0; x < box.max.x; ++x)
        ASSERT_NEAR(probability_of(once.log_odds({x, y})),
                    probability_of(grid.log_odds(Cell{x, y} + grid.bounds().min)),
                    0.0055)  // half a percent, and half a step of the log-odds
            << x << "," << y;
    EXPECT_EQ(difference(once, read_back(map_server_of(once, mode), PictureFormat::png).grid), "");
  }
}

TEST(MapServerWrite, TrinaryReportsWhatItTakesForUnknown) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds({0, 0}, 100);
  grid.set_log_odds({1, 0}, -200);
  const ExportedGrid exported = map_server_of(grid, MapServerMode::trinary);
  EXPECT_EQ(exported.picture.grey, (std::vector<std::uint8_t>{205, 254}));
  ASSERT_EQ(exported.warnings.size(), 1U);
  EXPECT_TRUE(exported.warnings[0].starts_with("1 cell: seen, but neither free nor occupied")) << exported.warnings[0];
}

TEST(MapServerWrite, RawAndScaleReportWhichSeenCellsComeBackUnseen) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds({0, 0}, 2);  // 50.2 %
  grid.set_log_odds({1, 0}, -200);
  for (const MapServerMode mode : {MapServerMode::raw, MapServerMode::scale}) {
    const ExportedGrid exported = map_server_of(grid, mode);
    ASSERT_EQ(exported.warnings.size(), 1U);
    EXPECT_TRUE(exported.warnings[0].starts_with("1 cell: seen, and as likely free as occupied"))
        << exported.warnings[0];
    const OccupancyGrid back = read_back(exported, PictureFormat::png).grid;
    EXPECT_EQ(back.log_odds(back.bounds().min), 0);
  }
}

TEST(MapServerWrite, TheGreysAreMapServers) {
  OccupancyGrid grid(0.05);
  for (int x = 0; x < 3; ++x) grid.set_log_odds({x, 0}, static_cast<LogOdds>(1024 * (x - 1)));
  EXPECT_EQ(map_server_of(grid, MapServerMode::trinary).picture.grey, (std::vector<std::uint8_t>{254, 205, 0}));
  EXPECT_TRUE(map_server_of(grid, MapServerMode::trinary).picture.alpha.empty());
  EXPECT_EQ(map_server_of(grid, MapServerMode::raw).picture.grey, (std::vector<std::uint8_t>{0, 255, 100}));
  EXPECT_EQ(map_server_of(grid, MapServerMode::scale).picture.grey, (std::vector<std::uint8_t>{255, 128, 0}));
  EXPECT_EQ(map_server_of(grid, MapServerMode::scale).picture.alpha, (std::vector<std::uint8_t>{255, 0, 255}));
  EXPECT_THROW(static_cast<void>(map_server_of(OccupancyGrid(0.05), MapServerMode::raw)), std::invalid_argument);
}

TEST(MapServerWrite, TheYamlHasMapServersOrderAndAllDigits) {
  const OccupancyGrid grid = grid_with([] { return LogOdds{0}; });
  EXPECT_EQ(
      map_server_yaml_of(map_server_of(grid, MapServerMode::trinary).settings, "lab.pgm"),
      "image: lab.pgm\nmode: trinary\nresolution: 0.0125\norigin: [-3.5124999999999997, 0.3958333333333333, 0.0]\n"
      "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  EXPECT_TRUE(map_server_yaml_of(map_server_of(grid, MapServerMode::scale).settings, "a b: c.png")
                  .starts_with("image: \"a b: c.png\"\nmode: scale\n"));
}

TEST(YamlText, APlusSignBelongsToANumber) {
  EXPECT_EQ(exchange::without_plus_sign("+.5"), ".5");
  EXPECT_EQ(exchange::without_plus_sign("-5"), "-5");
  EXPECT_EQ(exchange::without_plus_sign("+-5"), "+-5") << "no number";
}

TEST(YamlText, NumbersHaveNoExponentAndTextsAreNoOtherThing) {
  EXPECT_EQ(exchange::yaml_number(1e-7), "0.0000001");
  EXPECT_EQ(exchange::yaml_number(3e5), "300000.0");
  EXPECT_EQ(exchange::yaml_number(-0.1), "-0.1");
  for (const char* plain : {"L1", "map.pgm", "a_b-c"}) EXPECT_EQ(exchange::yaml_text(plain), plain);
  EXPECT_EQ(exchange::yaml_text("yes"), "\"yes\"");
  EXPECT_EQ(exchange::yaml_text("1e5"), "\"1e5\"");
  EXPECT_EQ(exchange::yaml_text("a\"\\\n"), "\"a\\\"\\\\\\x0A\"");
  EXPECT_EQ(exchange::yaml_text(""), "\"\"");
  EXPECT_EQ(exchange::yaml_flow_key("a"), "a:");
  EXPECT_EQ(exchange::yaml_block_key("a", "  "), "  a:");
  const std::string tabs(300, '\t');  // 1200 characters once they are escaped
  EXPECT_EQ(exchange::yaml_flow_key(tabs), "? " + exchange::yaml_text(tabs) + " :");
  EXPECT_EQ(exchange::yaml_block_key(tabs, "  "), "  ? " + exchange::yaml_text(tabs) + "\n  :");
}

}  // namespace
}  // namespace cairn
