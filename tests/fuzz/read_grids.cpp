#include "framework/config/config_value.hpp"
#include "framework/config/map_server_file.hpp"
#include "maps/exchange/moving_ai_map.hpp"
#include "maps/exchange/source_text.hpp"
#include "tests/fuzz/reader.hpp"

namespace cairn::fuzz {

void read_map_server(Input input) {
  const std::string_view bytes = text_of(input);
  const std::size_t end = bytes.find('\0');
  if (end == std::string_view::npos) return;
  constexpr std::int64_t kMostPixels = 1 << 10;  // a header alone can ask for more than a fuzzer's share of memory
  try {
    const GreyPicture picture = parse_grey_picture(bytes.substr(end + 1), "fuzzed", kMostPixels);
    const MapServerFile file = parse_map_server_yaml(std::string(bytes.substr(0, end)), "fuzzed.yaml");
    const CellBox box = grid_of(picture, file.settings, "fuzzed").grid.bounds();
    promise(std::int64_t{box.width()} * box.height() >= std::int64_t{picture.width} * picture.height,
            "the grid covers the picture");
  } catch (const ConfigError&) {
  } catch (const ExchangeError&) {
  }
}

void read_moving_ai_map(Input input) {
  try {
    const OccupancyGrid grid = parse_moving_ai_map(text_of(input), "fuzzed").grid;
    promise(known_ratio(grid) == 1.0, "there is a cell at least, and every cell is sure");
  } catch (const ExchangeError&) {
  }
}

}  // namespace cairn::fuzz
