#include <cmath>

#include "framework/config/config_value.hpp"
#include "framework/files/map_server_file.hpp"
#include "maps/base/source_text.hpp"
#include "maps/exchange/grids/grey_picture_write.hpp"
#include "maps/exchange/grids/map_server_write.hpp"
#include "maps/exchange/grids/moving_ai_map.hpp"
#include "tests/bench/routes/moving_ai_set.hpp"
#include "tests/fuzz/scratch.hpp"

namespace cairn::fuzz {
namespace {

constexpr std::int64_t kMaxPixels = 1 << 10;  // a header alone can ask for more than a fuzzer's share of memory

std::vector<LogOdds> cells_of(const OccupancyGrid& grid) {
  const CellBox box = grid.bounds();
  std::vector<LogOdds> cells(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()));
  grid.copy_log_odds(box, cells);
  return cells;
}

// Of a grid from a trinary or a raw picture.
void check_round_trip(const OccupancyGrid& grid, MapServerMode mode) {
  const ExportedGrid written = map_server_of(grid, mode);
  const OccupancyGrid again = grid_of(written.picture, written.settings, "written").grid;
  promise(cells_of(again) == cells_of(grid), "a written picture is the grid that was written");
}

}  // namespace

void read_map_server(Input input) {
  const std::string_view bytes = text_of(input);
  const std::size_t end = bytes.find('\0');
  if (end == std::string_view::npos) return;
  try {
    const GreyPicture picture = parse_grey_picture(bytes.substr(end + 1), "fuzzed", kMaxPixels);
    const MapServerFile file = parse_map_server_yaml(std::string(bytes.substr(0, end)), "fuzzed.yaml");
    const OccupancyGrid grid = grid_of(picture, file.settings, "fuzzed").grid;
    const CellBox box = grid.bounds();
    promise(std::int64_t{box.width()} * box.height() >= std::int64_t{picture.width} * picture.height,
            "the grid covers the picture");
    if (file.settings.mode != MapServerMode::scale) check_round_trip(grid, file.settings.mode);
  } catch (const ConfigError&) {
  } catch (const ExchangeError&) {
  }
}

void read_picture(Input input) {
  GreyPicture picture;
  try {
    picture = parse_grey_picture(text_of(input), "fuzzed", kMaxPixels);
  } catch (const ExchangeError&) {
    return;
  }
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  promise(picture.grey.size() == pixels && (picture.alpha.empty() || picture.alpha.size() == pixels),
          "a picture has all of its pixels");
  for (const PictureFormat format : {PictureFormat::pgm, PictureFormat::png, PictureFormat::bmp}) {
    const GreyPicture again = parse_grey_picture(picture_text_of(picture, format), "written");
    promise(again.width == picture.width && again.grey == picture.grey, "a written picture reads as what was written");
    promise(format == PictureFormat::pgm || again.alpha == picture.alpha, "and is as transparent");
  }
}

void read_moving_ai_map(Input input) {
  try {
    const OccupancyGrid grid = parse_moving_ai_map(text_of(input), "fuzzed").grid;
    promise(known_ratio(grid) == 1.0, "there is a cell at least, and every cell is sure");
  } catch (const ExchangeError&) {
  }
}

void read_moving_ai_scen(Input input) {
  const std::filesystem::path file = scratch_file("fuzzed.scen", text_of(input));
  constexpr int kHeight = 64;
  constexpr std::size_t kCount = 8;
  std::vector<MovingAiInstance> instances;
  try {
    instances = moving_ai_instances(file, kHeight, kCount, 1);
  } catch (const std::runtime_error&) {
    return;
  }
  promise(instances.size() <= kCount, "there are as many instances as are asked for");
  for (const MovingAiInstance& instance : instances) {
    promise(std::isfinite(instance.optimum), "a path has a length");
    for (const Cell cell : {instance.from, instance.to})
      promise(cell.x >= 0 && cell.y >= 0 && cell.y < kHeight, "an instance is on the map");
  }
}

}  // namespace cairn::fuzz
