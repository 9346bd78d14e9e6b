#include <cstdint>
#include <cstdlib>

#include "maps/exchange/moving_ai_map.hpp"
#include "maps/exchange/source_text.hpp"

// What is refused by ExchangeError is fine; what is read has a cell at least, and every cell is sure.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const cairn::OccupancyGrid grid =
        cairn::parse_moving_ai_map({reinterpret_cast<const char*>(data), size}, "fuzzed").grid;
    if (cairn::known_ratio(grid) != 1.0) std::abort();
  } catch (const cairn::ExchangeError&) {
  }
  return 0;
}
