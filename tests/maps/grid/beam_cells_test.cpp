#include "maps/grid/beam_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>

namespace cairn {
namespace {

std::set<Cell> cells_of(const Beam& beam, double cell_m) {
  const BeamFrame frame(beam, cell_m);
  std::set<Cell> cells;
  int last_y = std::numeric_limits<int>::min();
  std::vector<CellSpan> spans;
  spans_over(beam, cell_m, spans);
  for (const CellSpan& span : spans) {
    EXPECT_GT(span.y, last_y) << "rows rise and each has one span";
    last_y = span.y;
    for (int x = span.x_begin; x < span.x_end; ++x)
      if (frame.place_of({x, span.y}).is_inside) cells.insert({x, span.y});
  }
  return cells;
}

std::string drawing_of(const std::set<Cell>& cells, int width, int height) {
  std::string text;
  for (int y = height - 1; y >= 0; --y, text += '\n')
    for (int x = 0; x < width; ++x) text += cells.contains({x, y}) ? '*' : '.';
  return text;
}

TEST(BeamCells, OfAConeAreThoseWhoseCentreItHolds) {
  // Apex at the centre of cell (0, 2), looking right.
  EXPECT_EQ(drawing_of(cells_of({{0.05, 0.25, 0.0}, radians(30.0), 0.55}, 0.1), 8, 5),
            "....**..\n"
            "..****..\n"
            "******..\n"
            "..****..\n"
            "....**..\n");
}

TEST(BeamCells, OfARayAreThoseItTouches) {
  EXPECT_EQ(drawing_of(cells_of({{0.05, 0.05, std::atan2(2.0, 4.0)}, 0.0, 0.55}, 0.1), 6, 4),
            "......\n"
            "...***\n"
            ".***..\n"
            "**....\n");
  EXPECT_EQ(drawing_of(cells_of({{0.25, 0.35, -0.5 * std::numbers::pi}, 0.0, 0.25}, 0.1), 6, 4),
            "..*...\n"
            "..*...\n"
            "..*...\n"
            "......\n");
}

TEST(BeamCells, OfAConeMatchALookAtEveryCell) {
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> metres(-1.0, 1.0);
  for (int i = 0; i < 400; ++i) {
    const double half_beam_deg =
        i % 5 == 0 ? 90.0 + static_cast<double>(random() % 91) : 1.0 + static_cast<double>(random() % 89);
    const Beam beam{
        {metres(random), metres(random), i % 7 == 0 ? radians(45.0 * (i % 8)) : wrap_angle(3.2 * metres(random))},
        radians(half_beam_deg),
        0.1 + std::abs(metres(random))};
    std::set<Cell> expected;
    for (int y = -50; y < 50; ++y)
      for (int x = -50; x < 50; ++x) {
        const Point p = inverse(beam.T_map_sensor) * Point((x + 0.5) * 0.05, (y + 0.5) * 0.05);
        if (p.norm() <= beam.reach_m && std::abs(std::atan2(p.y(), p.x())) <= beam.half_beam_rad)
          expected.insert({x, y});
      }
    ASSERT_EQ(cells_of(beam, 0.05), expected) << "beam " << i << ", half " << half_beam_deg << " deg";
  }
}

TEST(BeamCells, OfARayMatchSmallStepsAlongIt) {
  std::mt19937_64 random(42);
  std::uniform_real_distribution<double> metres(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Beam beam{{metres(random), metres(random), 3.14 * metres(random)}, 0.0, 0.1 + std::abs(metres(random))};
    const std::set<Cell> cells = cells_of(beam, 0.05);
    const BeamFrame frame(beam, 0.05);
    for (double s = 0.0; s <= beam.reach_m; s += 0.001) {
      const Point p = beam.T_map_sensor * Point(s, 0.0);
      const Cell cell{static_cast<int>(std::floor(p.x() / 0.05)), static_cast<int>(std::floor(p.y() / 0.05))};
      ASSERT_TRUE(!frame.place_of(cell).is_inside || cells.contains(cell)) << "ray " << i << " at " << s << " m";
    }
    for (const Cell cell : cells) {  // and none that it passes by
      const Point p = inverse(beam.T_map_sensor) * Point((cell.x + 0.5) * 0.05, (cell.y + 0.5) * 0.05);
      ASSERT_LE(std::abs(p.y()), 0.05 * std::numbers::sqrt2 / 2.0);
    }
  }
}

TEST(BeamCells, AreNoneWithoutReach) {
  EXPECT_TRUE(cells_of({{}, radians(15.0), 0.0}, 0.05).empty());
  EXPECT_TRUE(cells_of({{}, 0.0, -1.0}, 0.05).empty());
}

}  // namespace
}  // namespace cairn
