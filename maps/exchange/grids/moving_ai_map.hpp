// Grids of the Moving AI benchmarks, `.map`:
//
//   type octile
//   height 2          height and width in any order
//   width 3
//   map
//   .@.               the top row first; free: . G S, blocked: @ O T W
//   ...
//
// One character becomes one cell, the origin is the lower left corner of the picture: column x of row y, both from 0,
// has its centre at ((x + 1/2) cell_m, (height - y - 1/2) cell_m). Line ends may be CRLF; blank lines may follow.
#pragma once

#include <string>
#include <string_view>

#include "maps/exchange/grids/imported_grid.hpp"

namespace cairn {

// Free and blocked cells are at the clamp of the log-odds, so surely so. Throws ExchangeError with file:line:column on
// anything else than the above, and on more cells than a grid can have; std::invalid_argument unless cell_m > 0.
[[nodiscard]] ImportedGrid parse_moving_ai_map(std::string_view text, const std::string& file_name,
                                               double cell_m = 1.0);

}  // namespace cairn
