#include "maps/exchange/grids/moving_ai_map.hpp"

#include <filesystem>
#include <random>

#include "tests/maps/exchange/exchange_fixture.hpp"

namespace cairn {
namespace {

constexpr const char* kSmall =
    "type octile\n"
    "height 3\n"
    "width 4\n"
    "map\n"
    ".@O.\n"
    "GSTW\n"
    "@...\n";

// As drawn, the top row first; '.' surely free, '#' surely occupied, '?' anything else.
std::string drawn(const OccupancyGrid& grid) {
  std::string text;
  const CellBox box = grid.bounds();
  for (int y = box.max.y - 1; y >= box.min.y; --y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const int log_odds = grid.log_odds({x, y});
      text += log_odds == -grid.clamp_quanta() ? '.' : log_odds == grid.clamp_quanta() ? '#' : '?';
    }
    text += '\n';
  }
  return text;
}

std::string refusal(const std::string& text) {
  return refusal_of([](const std::string& t, const std::string& name) { return parse_moving_ai_map(t, name); }, text);
}

TEST(MovingAiMap, TheTopRowIsTheHighestAndCellsAreSure) {
  const OccupancyGrid grid = parse_moving_ai_map(kSmall, "small.map").grid;
  EXPECT_EQ(drawn(grid),
            ".##.\n"
            "..##\n"
            "#...\n");
  EXPECT_EQ(grid.bounds(), (CellBox{{0, 0}, {4, 3}}));
  EXPECT_EQ(grid.cell_at({1.5, 2.5}), (Cell{1, 2}));  // column 1 of the top row
  EXPECT_EQ(grid.state({1, 2}), CellState::occupied);
  EXPECT_EQ(grid.state({1, 0}), CellState::free);
}

TEST(MovingAiMap, CellsAreAsLargeAsAskedFor) {
  const OccupancyGrid grid = parse_moving_ai_map(kSmall, "small.map", 0.25).grid;
  EXPECT_EQ(grid.cell_m(), 0.25);
  EXPECT_EQ(grid.centre_of({3, 2}), Point(0.875, 0.625));
  EXPECT_THROW(static_cast<void>(parse_moving_ai_map(kSmall, "small.map", 0.0)), std::invalid_argument);
}

TEST(MovingAiMap, OtherLineEndsAndOrdersAreRead) {
  EXPECT_EQ(drawn(parse_moving_ai_map("width 2\r\nheight 1\r\ntype octile\r\nmap\r\n.@\r\n\r\n", "m").grid), ".#\n");
  EXPECT_EQ(drawn(parse_moving_ai_map("type octile\nheight 1\nwidth 2\nmap\n@.", "m").grid), "#.\n");
}

TEST(MovingAiMap, AHeaderThatIsNotWholeIsRefused) {
  EXPECT_EQ(refusal(""),
            "1:1: there is no line \"map\", behind which the rows stand; the file ends here, it may have been cut");
  EXPECT_EQ(refusal("type octile\nheight 3\nmap\n...\n"), "3:1: no width stands before the map");
  EXPECT_EQ(refusal("height 1\nwidth 1\nmap\n.\n"), "3:1: no type stands before the map");
  EXPECT_EQ(refusal("type octle\n"),
            "1:6: the type \"octle\" is not known (did you mean \"octile\"?): octile is the one that is read");
  EXPECT_EQ(
      refusal("type octile\nheigth 3\n"),
      "2:1: unknown word \"heigth\" (did you mean \"height\"?): before the rows stand type, height, width and map");
  EXPECT_EQ(refusal("type octile\nwidth 3\nwidth 3\n"), "3:1: \"width\" stands here twice");
  EXPECT_EQ(refusal("type octile\nwidth\n"), "2:6: \"width\" needs a value");
  EXPECT_EQ(refusal("type octile\nwidth 3 4\n"), "2:9: \"4\" is too much");
}

TEST(MovingAiMap, SizesThatCannotBeAreRefusedBeforeAnyRow) {
  const std::string no_side = " is not a whole number of 1 to 131072";
  for (const char* side : {"0", "-3", "2.5", "abc", "131073", "99999999999999999999"})
    EXPECT_EQ(refusal("type octile\nheight " + std::string(side) + "\n"),
              "2:8: height \"" + std::string(side) + "\"" + no_side);
  EXPECT_EQ(refusal("type octile\nheight 131072\nwidth 131072\nmap\n"),
            "4:1: 131072 x 131072 cells are too many, at most 268435456 are possible");
}

TEST(MovingAiMap, RowsThatDoNotFitAreRefusedWithTheirPlace) {
  const std::string head = "type octile\nheight 2\nwidth 3\nmap\n";
  EXPECT_EQ(refusal(head + "...\n..\n"), "6:3: the row has 2 cells, width says 3");
  EXPECT_EQ(refusal(head + "....\n...\n"), "5:4: the row has 4 cells, width says 3");
  EXPECT_EQ(refusal(head + "...\n"), "6:1: the map has 1 row, height says 2; the file ends here, it may have been cut");
  EXPECT_EQ(refusal(head + "...\n...\n\n...\n"), "8:1: the map has more rows than the 2 that height says");
  EXPECT_EQ(refusal(head + "...\n.x.\n"), "6:2: unknown cell \"x\": free are . G S, blocked are @ O T W");
  EXPECT_EQ(refusal(head + "..\xC3\xA4\n...\n"), "5:3: unknown cell \"\xC3\xA4\": free are . G S, blocked are @ O T W");
  EXPECT_EQ(refusal(head + "...\n.\xFF.\n"), "6:2: is not UTF-8 text");
}

// Whatever becomes of one byte: refused with a place, or a whole map.
TEST(MovingAiMap, AByteChangedIsRefusedOrReadWhole) {
  std::mt19937_64 random(7);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string text = kSmall;
    text[random() % text.size()] = static_cast<char>(random());
    try {
      EXPECT_FALSE(parse_moving_ai_map(text, "m").grid.bounds().empty()) << text;
    } catch (const ExchangeError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 2000);
}

}  // namespace
}  // namespace cairn
