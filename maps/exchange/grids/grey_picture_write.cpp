#include "maps/exchange/grids/grey_picture_write.hpp"

#include <png.h>

#include <stdexcept>

namespace cairn {
namespace {

std::size_t pixels_of(const GreyPicture& picture) {
  return static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
}

void append(std::string& text, std::uint32_t value, int bytes) {
  for (; bytes > 0; --bytes, value >>= 8U) text += static_cast<char>(value & 0xFFU);
}

std::string pgm_of(const GreyPicture& picture) {
  std::string text = "P5\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n255\n";
  text.append(picture.grey.begin(), picture.grey.end());
  return text;
}

// The file's header and the picture's; the sizes of both, of masks and palette, are in `head`.
void append_bmp_header(std::string& text, const GreyPicture& picture, std::uint32_t head, std::uint32_t info,
                       unsigned bits, std::size_t bytes) {
  constexpr std::uint32_t kPixelsPerMetre = 2835;
  text += "BM";
  append(text, static_cast<std::uint32_t>(head + bytes), 4);
  append(text, 0, 4);
  append(text, head, 4);
  append(text, info, 4);
  append(text, static_cast<std::uint32_t>(picture.width), 4);
  append(text, static_cast<std::uint32_t>(picture.height), 4);
  append(text, 1, 2);
  append(text, bits, 2);
  append(text, bits == 32 ? 3 : 0, 4);  // 3: where the colours are, masks say
  append(text, static_cast<std::uint32_t>(bytes), 4);
  append(text, kPixelsPerMetre, 4);
  append(text, kPixelsPerMetre, 4);
  append(text, bits == 8 ? 256 : 0, 4);
  append(text, 0, 4);
}

std::string plain_bmp_of(const GreyPicture& picture) {
  const auto width = static_cast<std::size_t>(picture.width);
  const std::size_t stride = (width + 3) / 4 * 4;
  std::string text;
  append_bmp_header(text, picture, 14 + 40 + 256 * 4, 40, 8, stride * static_cast<std::size_t>(picture.height));
  for (std::uint32_t grey = 0; grey < 256; ++grey) append(text, grey * 0x010101U, 4);
  for (std::size_t y = static_cast<std::size_t>(picture.height); y-- > 0;) {
    const auto row = picture.grey.begin() + static_cast<std::ptrdiff_t>(y * width);
    text.append(row, row + picture.width);
    text.append(stride - width, '\0');
  }
  return text;
}

std::string bmp_with_alpha_of(const GreyPicture& picture) {
  constexpr std::uint32_t kInfo = 108;  // version 4, the first with a place for alpha
  std::string text;
  append_bmp_header(text, picture, 14 + kInfo, kInfo, 32, 4 * pixels_of(picture));
  for (const std::uint32_t mask : {0x00FF0000U, 0x0000FF00U, 0x000000FFU, 0xFF000000U}) append(text, mask, 4);
  append(text, 0x73524742U, 4);  // sRGB
  text.append(48, '\0');
  const auto width = static_cast<std::size_t>(picture.width);
  for (std::size_t y = static_cast<std::size_t>(picture.height); y-- > 0;)
    for (std::size_t at = y * width; at < (y + 1) * width; ++at)
      append(text, picture.grey[at] * 0x010101U | static_cast<std::uint32_t>(picture.alpha[at]) << 24U, 4);
  return text;
}

std::string png_of(const GreyPicture& picture) {
  std::string pixels(picture.grey.begin(), picture.grey.end());
  if (!picture.alpha.empty()) {
    pixels.resize(2 * pixels_of(picture));
    for (std::size_t i = 0; i < picture.grey.size(); ++i) {
      pixels[2 * i] = static_cast<char>(picture.grey[i]);
      pixels[2 * i + 1] = static_cast<char>(picture.alpha[i]);
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = picture.alpha.empty() ? PNG_FORMAT_GRAY : PNG_FORMAT_GA;
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string text(bytes, '\0');
  if (png_image_write_to_memory(&image, text.data(), &bytes, 0, pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error(std::string("the PNG picture cannot be made: ") + image.message);
  text.resize(bytes);
  return text;
}

}  // namespace

std::string picture_text_of(const GreyPicture& picture, PictureFormat format) {
  if (picture.width < 1 || picture.height < 1 || picture.grey.size() != pixels_of(picture) ||
      (!picture.alpha.empty() && picture.alpha.size() != picture.grey.size()))
    throw std::invalid_argument("picture_text_of: " + std::to_string(picture.grey.size()) +
                                " greys are no picture of " + std::to_string(picture.width) + " x " +
                                std::to_string(picture.height));
  switch (format) {
    case PictureFormat::pgm:
      return pgm_of(picture);
    case PictureFormat::png:
      return png_of(picture);
    case PictureFormat::bmp:
      return picture.alpha.empty() ? plain_bmp_of(picture) : bmp_with_alpha_of(picture);
  }
  throw std::logic_error("picture_text_of: no such format");
}

}  // namespace cairn
