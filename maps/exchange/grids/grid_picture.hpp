// A grid as a plain grey picture, so many pixels a cell and nothing else on it: for other tools and for print.
#pragma once

#include "maps/exchange/grids/grey_picture.hpp"

namespace cairn {

inline constexpr std::int64_t kMaxGridPicturePixels = std::int64_t{1} << 26;  // 8192 x 8192
inline constexpr int kMaxGridPictureSide = 1 << 16;

// The cells of grid.bounds(), y up: white free, black occupied, grey 128 unknown, between them by probability. A pixel
// is the mean of what it covers of the cells; the last column and the lowest row may reach beyond the grid. px_per_cell
// below 1 makes the picture smaller than the grid. Throws std::invalid_argument when the grid has no cells,
// px_per_cell is not a finite number above 0, or the picture would be larger than the limits above.
[[nodiscard]] GreyPicture grid_picture_of(const OccupancyGrid& grid, double px_per_cell);

}  // namespace cairn
