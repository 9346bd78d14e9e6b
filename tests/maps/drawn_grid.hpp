// Grids as drawings: '#' occupied, '.' free, '?' unknown; the first line is the highest row, and the
// lower left character is the cell `corner`.
#pragma once

#include <cctype>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "maps/grid/distance_field.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

inline OccupancyGrid drawn(const std::vector<std::string>& rows, double cell_m = 0.1, Cell corner = {0, 0}) {
  OccupancyGrid grid(cell_m);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t x = 0; x < rows[i].size(); ++x) {
      const Cell cell = corner + Cell{static_cast<int>(x), static_cast<int>(rows.size() - 1 - i)};
      grid.include({cell, cell + Cell{1, 1}});
      if (rows[i][x] != '?') grid.set_log_odds(cell, rows[i][x] == '#' ? LogOdds{1000} : LogOdds{-1000});
    }
  return grid;
}

// What a drawing says of a box, for failures.
inline std::string drawing_of(const OccupancyGrid& grid) {
  const CellBox box = grid.bounds();
  std::string text = "\n";
  for (int y = box.max.y - 1; y >= box.min.y; --y, text += '\n')
    for (int x = box.min.x; x < box.max.x; ++x) {
      const CellState state = grid.state({x, y});
      text += state == CellState::occupied ? '#' : state == CellState::free ? '.' : '?';
    }
  return text;
}

struct Drawing {
  OccupancyGrid grid;
  DistanceField space;
  std::map<char, Point> at_m;  // centres of the lettered cells, which are free
};

inline Drawing read_drawing(std::vector<std::string> rows, double cell_m = 0.1) {
  std::map<char, Cell> letters;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t x = 0; x < rows[i].size(); ++x)
      if (std::isalpha(static_cast<unsigned char>(rows[i][x]))) {
        letters[rows[i][x]] = {static_cast<int>(x), static_cast<int>(rows.size() - 1 - i)};
        rows[i][x] = '.';
      }
  Drawing drawing{drawn(rows, cell_m), {}, {}};
  drawing.space = DistanceField(drawing.grid, UnknownPolicy::avoid);
  for (const auto& [letter, cell] : letters) drawing.at_m[letter] = drawing.grid.centre_of(cell);
  return drawing;
}

inline OccupancyGrid random_maze(std::mt19937_64& random) {
  OccupancyGrid grid(0.05);
  const int width = 4 + static_cast<int>(random() % 24);
  const int height = 4 + static_cast<int>(random() % 24);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) grid.set_log_odds({x - 9, y - 5}, random() % 4 == 0 ? LogOdds{900} : LogOdds{-900});
  return grid;
}

}  // namespace cairn
