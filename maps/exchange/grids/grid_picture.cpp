#include "maps/exchange/grids/grid_picture.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "maps/base/source_text.hpp"

namespace cairn {
namespace {

// The cells that a pixel covers along one axis, and how much of each.
struct Cover {
  int first = 0;
  std::vector<double> shares;  // sum 1
};

std::vector<Cover> covers_of(int cells, int pixels, double px_per_cell) {
  constexpr double kTouching = 1e-9;  // of a cell
  std::vector<Cover> covers(static_cast<std::size_t>(pixels));
  for (int i = 0; i < pixels; ++i) {
    Cover& cover = covers[static_cast<std::size_t>(i)];
    const double begin = i / px_per_cell;
    const double end = std::min((i + 1) / px_per_cell, static_cast<double>(cells));
    cover.first = std::min(static_cast<int>(std::floor(begin + kTouching)), cells - 1);
    for (int cell = cover.first; cell < cells && cell + kTouching < end; ++cell)
      cover.shares.push_back(std::min(end, cell + 1.0) - std::max(begin, static_cast<double>(cell)));
    double sum = 0.0;
    for (const double share : cover.shares) sum += share;
    for (double& share : cover.shares) share /= sum;
  }
  return covers;
}

int side_of(int cells, double px_per_cell) {
  constexpr double kRounding = 1e-6;  // of a pixel
  const double side = std::max(1.0, std::ceil(cells * px_per_cell - kRounding));
  return static_cast<int>(std::min(side, 1e9));
}

}  // namespace

GreyPicture grid_picture_of(const OccupancyGrid& grid, double px_per_cell) {
  const CellBox box = grid.bounds();
  if (box.empty()) throw std::invalid_argument("the grid has no cells to draw");
  if (!(px_per_cell > 0.0) || !std::isfinite(px_per_cell))
    throw std::invalid_argument("a scale must be a finite number above 0, is " + exchange::number_text(px_per_cell));
  GreyPicture picture{side_of(box.width(), px_per_cell), side_of(box.height(), px_per_cell), {}, {}};
  if (picture.width > kMaxGridPictureSide || picture.height > kMaxGridPictureSide ||
      std::int64_t{picture.width} * picture.height > kMaxGridPicturePixels)
    throw std::invalid_argument("a scale of " + exchange::number_text(px_per_cell) + " makes " +
                                std::to_string(picture.width) + " x " + std::to_string(picture.height) + " pixels of " +
                                std::to_string(box.width()) + " x " + std::to_string(box.height()) +
                                " cells, possible are " + std::to_string(kMaxGridPictureSide) + " a side and " +
                                std::to_string(kMaxGridPicturePixels) + " in all");
  const std::vector<Cover> across = covers_of(box.width(), picture.width, px_per_cell);
  const std::vector<Cover> down = covers_of(box.height(), picture.height, px_per_cell);
  const auto width = static_cast<std::size_t>(box.width());
  std::vector<std::uint8_t> ol(width);
  std::vector<double> mean(width);
  picture.grey.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  for (const Cover& rows : down) {
    std::ranges::fill(mean, 0.0);
    for (std::size_t i = 0; i < rows.shares.size(); ++i) {
      const int y = box.max.y - 1 - rows.first - static_cast<int>(i);
      grid.copy_ol({{box.min.x, y}, {box.max.x, y + 1}}, ol);
      for (std::size_t x = 0; x < width; ++x) mean[x] += rows.shares[i] * ol[x];
    }
    for (const Cover& columns : across) {
      double value = 0.0;
      for (std::size_t i = 0; i < columns.shares.size(); ++i)
        value += columns.shares[i] * mean[static_cast<std::size_t>(columns.first) + i];
      picture.grey.push_back(static_cast<std::uint8_t>(255 - std::clamp(std::lround(value), 0L, 255L)));
    }
  }
  return picture;
}

}  // namespace cairn
