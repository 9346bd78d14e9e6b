// The readers behind grey_picture.hpp, one a format.
#pragma once

#include <string>
#include <string_view>

#include "maps/exchange/grids/grey_picture.hpp"

namespace cairn::exchange {

struct PictureSource {
  std::string_view bytes;
  const std::string& file;
  std::int64_t max_pixels = 0;

  [[noreturn]] void fail(const std::string& sentence) const;  // "file: sentence"
  // A picture of that size without content. Fails on sizes that are refused.
  [[nodiscard]] GreyPicture sized(std::int64_t width, std::int64_t height) const;
};

[[nodiscard]] GreyPicture read_bmp(const PictureSource& source);
[[nodiscard]] GreyPicture read_pgm(const PictureSource& source);
[[nodiscard]] GreyPicture read_png(const PictureSource& source);

// The mean, rounded.
[[nodiscard]] constexpr std::uint8_t grey_of(unsigned red, unsigned green, unsigned blue) {
  return static_cast<std::uint8_t>((2 * (red + green + blue) + 3) / 6);
}

}  // namespace cairn::exchange
