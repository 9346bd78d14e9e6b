#include <cstdint>
#include <cstdlib>

#include "framework/config/config_value.hpp"
#include "framework/config/map_server_file.hpp"
#include "maps/exchange/source_text.hpp"

// The YAML up to the first byte 0, then the picture. What is refused by its two errors is fine; what is read covers
// the picture.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = bytes.find('\0');
  if (end == std::string_view::npos) return 0;
  constexpr std::int64_t kMostPixels = 1 << 10;  // a header alone can ask for more than a fuzzer's share of memory
  try {
    const cairn::GreyPicture picture = cairn::parse_grey_picture(bytes.substr(end + 1), "fuzzed", kMostPixels);
    const cairn::MapServerFile file = cairn::parse_map_server_yaml(std::string(bytes.substr(0, end)), "fuzzed.yaml");
    const cairn::CellBox box = cairn::grid_of(picture, file.settings, "fuzzed").grid.bounds();
    const std::int64_t cells = std::int64_t{box.width()} * box.height();
    if (cells < std::int64_t{picture.width} * picture.height) std::abort();
  } catch (const cairn::ConfigError&) {
  } catch (const cairn::ExchangeError&) {
  }
  return 0;
}
