// What every fuzzer of a graph reader does: the bytes as text; what is read is sound, and survives a round trip.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "maps/exchange/exchanged_graph.hpp"
#include "maps/exchange/source_text.hpp"

namespace cairn::fuzz {

// What parse() refuses by ExchangeError is fine, anything else is a find; and what it takes, it takes again once
// written.
template <class Parse, class Write>
int exchange(const std::uint8_t* data, std::size_t size, Parse parse, Write write) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ImportedGraph read;
  try {
    read = parse(text, "fuzzed");
  } catch (const ExchangeError&) {
    return 0;
  }
  for (const auto& [id, landmark] : read.graph.landmarks())
    if (!std::isfinite(landmark.T_map_landmark.x_m + landmark.T_map_landmark.y_m) &&
        !landmark.T_map_landmark.position().allFinite())
      std::abort();
  for (const auto& [id, route] : read.graph.routes())
    if (!(route.cost_m >= 0.0) || !std::isfinite(route.cost_m)) std::abort();
  if (read.graph.landmarks().empty()) std::abort();
  const ImportedGraph again = parse(write(read.graph).text, "written");
  if (again.graph.landmarks().size() != read.graph.landmarks().size()) std::abort();
  const std::string written = write(again.graph).text;  // ids have settled now
  if (write(parse(written, "written again").graph).text != written) std::abort();
  return 0;
}

}  // namespace cairn::fuzz
