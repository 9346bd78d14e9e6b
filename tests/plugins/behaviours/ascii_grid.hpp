// A grid from a drawing, a character a cell: '#' occupied, '.' free, ' ' unknown; letters are free
// places that can be asked for. Cell (0, 0) is the lower left character.
#pragma once

#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn::behaviours {

struct AsciiGrid {
  OccupancyGrid grid;
  std::map<char, Cell> places;

  explicit AsciiGrid(const std::string& drawing, double cell_m = 0.1) : grid(cell_m) {
    std::vector<std::string> rows;
    std::istringstream lines(drawing);
    for (std::string line; std::getline(lines, line);)
      if (!line.empty()) rows.push_back(line);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (std::size_t c = 0; c < rows[r].size(); ++c) {
        const Cell cell{static_cast<int>(c), static_cast<int>(rows.size() - 1 - r)};
        const char what = rows[r][c];
        grid.set_log_odds(cell, what == ' ' ? LogOdds{0} : what == '#' ? LogOdds{600} : LogOdds{-600});
        if (std::isalpha(static_cast<unsigned char>(what))) places[what] = cell;
      }
    }
  }
  [[nodiscard]] Point at(char place) const { return grid.centre_of(places.at(place)); }
};

}  // namespace cairn::behaviours
