// Grey pictures as other tools keep occupancy grids in: PGM (P2, P5), PNG, BMP (not compressed).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

struct GreyPicture {
  int width = 0;  // pixels, at least 1
  int height = 0;
  std::vector<std::uint8_t> grey;   // row by row, the top row first; 0 black, 255 white
  std::vector<std::uint8_t> alpha;  // as grey, 255 opaque; empty: all opaque
};

// What the bytes begin with says which format they are in. Of colours the mean of red, green and blue is taken; other
// depths are scaled to 0 ... 255. Throws ExchangeError on anything else, with line and column in a PGM's text; a
// picture of more pixels is refused by its header, before memory is asked for.
[[nodiscard]] GreyPicture parse_grey_picture(std::string_view bytes, const std::string& file_name,
                                             std::int64_t max_pixels = OccupancyGrid::kMaxCells);

}  // namespace cairn
