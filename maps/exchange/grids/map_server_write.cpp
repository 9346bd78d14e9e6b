#include "maps/exchange/grids/map_server_write.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/base/yaml_text.hpp"

namespace cairn {
namespace {

constexpr std::uint8_t kFreeGrey = 254;
constexpr std::uint8_t kOccupiedGrey = 0;
constexpr std::uint8_t kUnknownRaw = 255;
constexpr std::uint8_t kHalfGrey = 128;  // of what is unknown beneath its transparency

constexpr const char* name_of(MapServerMode mode) {
  return mode == MapServerMode::trinary ? "trinary" : mode == MapServerMode::scale ? "scale" : "raw";
}

// What a reader makes of 0 and 100, whatever the clamp of the grid that is written.
constexpr int kSurely = 4 * static_cast<int>(kLogOddsPerNat);

int percent_of(LogOdds log_odds) {
  if (log_odds >= kSurely) return 100;
  if (log_odds <= -kSurely) return 0;
  return std::clamp(static_cast<int>(std::lround(100.0 * probability_of(log_odds))), 1, 99);
}

std::uint8_t grey_of(LogOdds log_odds, MapServerMode mode) {
  if (mode == MapServerMode::trinary) {
    const CellState state = OccupancyThresholds{}.state(log_odds);
    return state == CellState::free ? kFreeGrey : state == CellState::occupied ? kOccupiedGrey : kUnknownGrey;
  }
  if (mode == MapServerMode::raw) return log_odds == 0 ? kUnknownRaw : static_cast<std::uint8_t>(percent_of(log_odds));
  if (log_odds == 0) return kHalfGrey;
  return static_cast<std::uint8_t>(std::lround(255.0 * (100 - percent_of(log_odds)) / 100.0));
}

MapServerSettings settings_of(const OccupancyGrid& grid, MapServerMode mode) {
  MapServerSettings settings;
  settings.mode = mode;
  settings.resolution_m = grid.cell_m();
  const CellBox box = grid.bounds();
  const Point corner = grid.origin_m() + grid.cell_m() * Point(box.min.x, box.min.y);
  settings.origin = {corner.x(), corner.y(), 0.0};
  if (mode == MapServerMode::scale) {
    settings.occupied_thresh = 1.0;
    settings.free_thresh = 0.0;
  }
  return settings;
}

}  // namespace

ExportedGrid map_server_of(const OccupancyGrid& grid, MapServerMode mode) {
  const CellBox box = grid.bounds();
  if (box.empty()) throw std::invalid_argument("map_server_of: the grid has no cells");
  ExportedGrid exported{{box.width(), box.height(), {}, {}}, settings_of(grid, mode), {}};
  const auto count = static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height());
  exported.picture.grey.reserve(count);
  if (mode == MapServerMode::scale) exported.picture.alpha.reserve(count);
  std::vector<LogOdds> row(static_cast<std::size_t>(box.width()));
  std::size_t doubtful = 0;
  std::size_t even = 0;
  for (int y = box.max.y - 1; y >= box.min.y; --y) {
    grid.copy_log_odds({{box.min.x, y}, {box.max.x, y + 1}}, row);
    for (const LogOdds log_odds : row) {
      exported.picture.grey.push_back(grey_of(log_odds, mode));
      if (mode == MapServerMode::scale) exported.picture.alpha.push_back(log_odds == 0 ? 0 : 255);
      if (log_odds == 0) continue;
      doubtful += OccupancyThresholds{}.state(log_odds) == CellState::unknown;
      even += percent_of(log_odds) == 50;
    }
  }
  if (mode == MapServerMode::trinary && doubtful > 0)
    exported.warnings.push_back(counted(doubtful, "cell") +
                                ": seen, but neither free nor occupied (0.35 to 0.65), and so written as unknown; "
                                "scale and raw keep the percent");
  if (mode != MapServerMode::trinary && even > 0)
    exported.warnings.push_back(counted(even, "cell") +
                                ": seen, and as likely free as occupied (50 %); read back they are unseen");
  return exported;
}

std::string map_server_yaml_of(const MapServerSettings& settings, const std::string& picture_file) {
  using exchange::yaml_number;
  return "image: " + exchange::yaml_text(picture_file) + "\nmode: " + name_of(settings.mode) +
         "\nresolution: " + yaml_number(settings.resolution_m) + "\norigin: [" + yaml_number(settings.origin.x_m) +
         ", " + yaml_number(settings.origin.y_m) + ", " + yaml_number(settings.origin.theta_rad) +
         "]\nnegate: " + (settings.negate ? "1" : "0") + "\noccupied_thresh: " + yaml_number(settings.occupied_thresh) +
         "\nfree_thresh: " + yaml_number(settings.free_thresh) + "\n";
}

}  // namespace cairn
