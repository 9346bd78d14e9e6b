// The colours of Cairn's pictures.
#pragma once

#include <cstddef>
#include <string>

#include "maps/pictures/drawing/canvas.hpp"

namespace cairn::pictures {

inline constexpr Colour kPaper{250, 250, 248};
inline constexpr Colour kInk{38, 50, 56};
inline constexpr Colour kFaintInk{120, 132, 140};
inline constexpr Colour kFrame{176, 184, 190};
inline constexpr Colour kWhite{255, 255, 255};
inline constexpr Colour kRoute{92, 107, 192};
inline constexpr Colour kClosed{198, 40, 40};
inline constexpr Colour kDriven{84, 146, 150};
inline constexpr Colour kPlanned{239, 108, 0};
inline constexpr Colour kStart{46, 125, 50};
inline constexpr Colour kGoal{194, 24, 91};
inline constexpr Colour kRobot{33, 64, 110};

// 0 free (white), 127 unknown (grey), 255 occupied (black), continuous in between.
[[nodiscard]] Colour colour_of_ol(double ol);
// Distinct for the first eight, then again from the first.
[[nodiscard]] Colour category_colour(std::size_t index);
// Full colour wheel: hue in [0, 1), value in [0, 1].
[[nodiscard]] Colour colour_of_hue(double hue, double value);

}  // namespace cairn::pictures
