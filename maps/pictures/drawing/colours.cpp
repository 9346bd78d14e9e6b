#include "maps/pictures/drawing/colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn::pictures {
namespace {

std::uint8_t byte_of(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

Colour mixed(Colour a, Colour b, double share_of_b) {
  const auto mix = [share_of_b](int from, int to) { return byte_of(from + (to - from) * share_of_b); };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

constexpr Colour kUnknown{200, 204, 208};
constexpr Colour kOccupied{22, 27, 34};
constexpr double kUnknownLevel = 127.0;

}  // namespace

Colour colour_of_ol(double ol) {
  if (ol <= kUnknownLevel) return mixed(kWhite, kUnknown, ol / kUnknownLevel);
  return mixed(kUnknown, kOccupied, (ol - kUnknownLevel) / (255.0 - kUnknownLevel));
}

Colour category_colour(std::size_t index) {
  static constexpr std::array<Colour, 8> kColours{Colour{211, 60, 75},  Colour{25, 118, 210}, Colour{56, 142, 60},
                                                  Colour{142, 68, 173}, Colour{230, 145, 0},  Colour{0, 131, 143},
                                                  Colour{141, 90, 60},  Colour{194, 24, 130}};
  return kColours[index % kColours.size()];
}

Colour colour_of_hue(double hue, double value) {
  const auto part = [&](double offset) {
    const double wave = std::abs(std::fmod(hue * 6.0 + offset, 6.0) - 3.0) - 1.0;
    return byte_of(255.0 * value * std::clamp(wave, 0.0, 1.0));
  };
  return {part(0.0), part(4.0), part(2.0)};
}

}  // namespace cairn::pictures
