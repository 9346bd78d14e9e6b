// Grey pictures as the bytes of a file, for other tools to read; parse_grey_picture() reads them back as they were.
#pragma once

#include <string>

#include "maps/exchange/grids/grey_picture.hpp"

namespace cairn {

enum class PictureFormat { pgm, png, bmp };

// PGM has no place for transparency: alpha is left out. BMP is written with a palette of greys, with alpha in 32 bits a
// pixel. The same picture gives the same bytes. Throws std::invalid_argument when sizes do not fit together,
// std::runtime_error when libpng fails.
[[nodiscard]] std::string picture_text_of(const GreyPicture& picture, PictureFormat format);

}  // namespace cairn
