// Formats are read by libpng and by hand: OpenCV's reader would load a hundred libraries at every start.
#include "maps/exchange/grids/grey_picture.hpp"

#include <png.h>

#include "maps/base/source_text.hpp"
#include "maps/exchange/grids/grey_picture_readers.hpp"

namespace cairn {
namespace exchange {
namespace {

struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(this); }
};

}  // namespace

void PictureSource::fail(const std::string& sentence) const {
  throw ExchangeError(file + ": " + sentence);
}

GreyPicture PictureSource::sized(std::int64_t width, std::int64_t height) const {
  constexpr std::int64_t kMaxSide = OccupancyGrid::kLargestCellIndex;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide || width * height > max_pixels)
    fail("the picture has " + std::to_string(width) + " x " + std::to_string(height) + " pixels, possible are 1 to " +
         std::to_string(kMaxSide) + " a side and " + std::to_string(max_pixels) + " in all");
  return {static_cast<int>(width), static_cast<int>(height), {}, {}};
}

GreyPicture read_png(const PictureSource& source) {
  PngImage image;
  if (png_image_begin_read_from_memory(&image, source.bytes.data(), source.bytes.size()) == 0)
    source.fail(std::string("is not a PNG picture that can be read: ") + image.message);
  GreyPicture picture = source.sized(image.width, image.height);
  const bool in_colour = (image.format & PNG_FORMAT_FLAG_COLOR) != 0;
  const bool has_alpha = (image.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // 16 bits mean the same greys as 8
  image.format = in_colour ? PNG_FORMAT_RGBA : PNG_FORMAT_GA;
  const std::size_t channels = in_colour ? 4 : 2;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0)
    source.fail(std::string("the PNG picture cannot be read: ") + image.message);
  const std::size_t count = pixels.size() / channels;
  picture.grey.resize(count);
  if (has_alpha) picture.alpha.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* const p = &pixels[i * channels];
    picture.grey[i] = in_colour ? grey_of(p[0], p[1], p[2]) : p[0];
    if (has_alpha) picture.alpha[i] = p[channels - 1];
  }
  return picture;
}

}  // namespace exchange

GreyPicture parse_grey_picture(std::string_view bytes, const std::string& file_name, std::int64_t max_pixels) {
  const exchange::PictureSource source{bytes, file_name, max_pixels};
  if (bytes.starts_with("P2") || bytes.starts_with("P5")) return exchange::read_pgm(source);
  if (bytes.starts_with("\x89PNG")) return exchange::read_png(source);
  if (bytes.starts_with("BM")) return exchange::read_bmp(source);
  source.fail("is not a picture in PGM, PNG or BMP");
}

}  // namespace cairn
