#include "maps/exchange/grids/map_server.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "maps/base/source_text.hpp"

namespace cairn {
namespace {

// Probability of being occupied; none: unknown.
std::optional<double> probability_of_grey(std::uint8_t grey, const MapServerSettings& settings) {
  if (settings.mode == MapServerMode::raw) return grey <= 100 ? std::optional(grey / 100.0) : std::nullopt;
  const double light = grey / 255.0;
  const double p = settings.negate ? light : 1.0 - light;
  if (p <= settings.free_thresh) return 0.0;
  if (p >= settings.occupied_thresh) return 1.0;
  if (settings.mode == MapServerMode::trinary) return std::nullopt;
  return std::round(100.0 * (p - settings.free_thresh) / (settings.occupied_thresh - settings.free_thresh)) / 100.0;
}

// A picture as cells: column 0 and row 0 at the lower left.
class PictureCells {
 public:
  PictureCells(const GreyPicture& picture, const MapServerSettings& settings, int clamp)
      : picture_(picture), heeds_alpha_(settings.mode != MapServerMode::raw && !picture.alpha.empty()) {
    for (std::size_t grey = 0; grey < log_odds_.size(); ++grey) {
      const std::optional<double> p = probability_of_grey(static_cast<std::uint8_t>(grey), settings);
      log_odds_[grey] = static_cast<LogOdds>(p ? std::clamp<int>(log_odds_of(*p), -clamp, clamp) : 0);
    }
  }

  [[nodiscard]] CellBox box() const { return {{0, 0}, {picture_.width, picture_.height}}; }
  [[nodiscard]] LogOdds at(Cell cell) const {
    const std::size_t index =
        static_cast<std::size_t>(picture_.height - 1 - cell.y) * static_cast<std::size_t>(picture_.width) +
        static_cast<std::size_t>(cell.x);
    if (heeds_alpha_ && picture_.alpha[index] < 255) return 0;
    return log_odds_[picture_.grey[index]];
  }

 private:
  const GreyPicture& picture_;
  bool heeds_alpha_;
  std::array<LogOdds, 256> log_odds_{};
};

OccupancyGrid straight_grid(const PictureCells& cells, const MapServerSettings& settings) {
  OccupancyGrid grid(settings.resolution_m, OccupancyGrid(1.0).clamp_nat(), settings.origin.position());
  const CellBox box = cells.box();
  grid.include(box);
  for (int y = 0; y < box.max.y; ++y)
    for (int x = 0; x < box.max.x; ++x)
      if (const LogOdds log_odds = cells.at({x, y}); log_odds != 0) grid.set_log_odds({x, y}, log_odds);
  return grid;
}

// The most occupied of the pixels that a cell overlaps; beyond the picture all is unknown. None: the cell lies beyond
// the picture altogether. Two squares of one size overlap when they do along the axes of both.
std::optional<LogOdds> covered_by(Cell cell, const OccupancyGrid& grid, const PictureCells& cells,
                                  const MapServerSettings& settings) {
  constexpr double kTouching = 1e-6;  // of a cell: no overlap
  const Pose2 turn{0.0, 0.0, settings.origin.theta_rad};
  const double reach = 0.5 * (1.0 + turn.direction().cwiseAbs().sum()) - kTouching;
  const Point centre = inverse(settings.origin) * grid.centre_of(cell) / settings.resolution_m;  // in pixels
  const Cell around = cell_on_lattice(centre, {0.0, 0.0}, 1.0);
  std::optional<LogOdds> most;
  bool reaches_beyond = false;
  for (int i = 0; i < 9; ++i) {
    const Cell pixel = around + Cell{i % 3 - 1, i / 3 - 1};
    const Point offset = Point(pixel.x + 0.5, pixel.y + 0.5) - centre;
    if (offset.cwiseAbs().maxCoeff() >= reach || (turn * offset).cwiseAbs().maxCoeff() >= reach) continue;
    if (!cells.box().contains(pixel))
      reaches_beyond = true;
    else
      most = std::max(most.value_or(std::numeric_limits<LogOdds>::min()), cells.at(pixel));
  }
  if (most && reaches_beyond) most = std::max(*most, LogOdds{0});
  return most;
}

OccupancyGrid turned_grid(const PictureCells& cells, const MapServerSettings& settings, const std::string& file_name) {
  const Point extent = settings.resolution_m * Point(cells.box().max.x, cells.box().max.y);
  Point low = settings.origin.position();
  Point high = low;
  for (const Point& corner : {Point(extent.x(), 0.0), extent, Point(0.0, extent.y())}) {
    low = low.cwiseMin(settings.origin * corner);
    high = high.cwiseMax(settings.origin * corner);
  }
  OccupancyGrid grid(settings.resolution_m, OccupancyGrid(1.0).clamp_nat(), low);
  constexpr double kRounding = 1e-6;  // cells: a right angle needs no more cells than the picture has
  const Point size = (high - low) / settings.resolution_m;
  const CellBox box{
      {0, 0}, {static_cast<int>(std::ceil(size.x() - kRounding)), static_cast<int>(std::ceil(size.y() - kRounding))}};
  try {
    grid.include(box);
  } catch (const std::length_error& error) {
    throw ExchangeError(file_name + ": the picture, turned by the origin's yaw, is too large: " + error.what());
  }
  for (int y = 0; y < box.max.y; ++y)
    for (int x = 0; x < box.max.x; ++x)
      if (const auto log_odds = covered_by({x, y}, grid, cells, settings).value_or(0); log_odds != 0)
        grid.set_log_odds({x, y}, log_odds);
  return grid;
}

}  // namespace

ImportedGrid grid_of(const GreyPicture& picture, const MapServerSettings& settings, const std::string& file_name) {
  const OccupancyGrid plain(1.0);
  const PictureCells cells(picture, settings, plain.clamp_quanta());
  // What moves no pixel by a hundredth of its side is a rounding error.
  const bool is_turned = std::abs(settings.origin.theta_rad) * std::max(picture.width, picture.height) > 0.01;
  ImportedGrid imported{is_turned ? turned_grid(cells, settings, file_name) : straight_grid(cells, settings), {}};
  if (is_turned)
    imported.warnings.push_back("the origin is turned by " + exchange::number_text(degrees(settings.origin.theta_rad)) +
                                " deg: the picture was laid anew on the map's axes, walls are up to a cell thicker");
  const std::optional<double> unknown = probability_of_grey(kUnknownGrey, settings);
  if (settings.mode == MapServerMode::trinary && unknown && std::ranges::count(picture.grey, kUnknownGrey) > 0)
    imported.warnings.push_back("grey 205, by which map_server means unknown, counts as " +
                                std::string(*unknown == 0.0 ? "free" : "occupied") + " by these thresholds");
  return imported;
}

}  // namespace cairn
