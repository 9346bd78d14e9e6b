#include <array>

#include "maps/base/source_text.hpp"
#include "maps/exchange/grids/grey_picture_readers.hpp"

namespace cairn::exchange {
namespace {

constexpr std::size_t kInfo = 14;  // where the picture's header begins, behind the file's
constexpr std::uint32_t kPlain = 0;
constexpr std::uint32_t kMasked = 3;

struct Header {
  std::uint32_t pixels = 0;  // offset
  std::uint32_t info_size = 0;
  std::int32_t width = 0;
  std::int32_t height = 0;  // negative: the top row first
  unsigned bits = 0;        // a pixel
  std::uint32_t compression = 0;
  std::uint32_t colours = 0;
  bool has_alpha = false;
};

// Little endian; fails beyond the end.
std::uint32_t number_at(const PictureSource& source, std::size_t offset, std::size_t size) {
  if (offset + size > source.bytes.size()) source.fail("the BMP picture ends too early; it may have been cut");
  std::uint32_t value = 0;
  for (std::size_t i = size; i-- > 0;)
    value = value << 8U | static_cast<std::uint32_t>(static_cast<unsigned char>(source.bytes[offset + i]));
  return value;
}

void check_masks(const PictureSource& source, Header& header) {
  constexpr std::array<std::uint32_t, 3> kUsual{0x00FF0000, 0x0000FF00, 0x000000FF};
  for (std::size_t i = 0; i < kUsual.size(); ++i)
    if (header.bits != 32 || number_at(source, kInfo + 40 + 4 * i, 4) != kUsual[i])
      source.fail("the BMP picture keeps its colours in unusual bits; save it with 8, 24 or 32 bits a pixel");
  header.has_alpha = header.info_size >= 56 && number_at(source, kInfo + 52, 4) == 0xFF000000;
}

Header header_of(const PictureSource& source) {
  Header header;
  header.pixels = number_at(source, 10, 4);
  header.info_size = number_at(source, kInfo, 4);
  if (header.info_size < 40) source.fail("the BMP picture is of a kind from before Windows 3, which is not read");
  header.width = static_cast<std::int32_t>(number_at(source, kInfo + 4, 4));
  header.height = static_cast<std::int32_t>(number_at(source, kInfo + 8, 4));
  header.bits = number_at(source, kInfo + 14, 2);
  header.compression = number_at(source, kInfo + 16, 4);
  header.colours = number_at(source, kInfo + 32, 4);
  if (header.bits != 1 && header.bits != 4 && header.bits != 8 && header.bits != 24 && header.bits != 32)
    source.fail("the BMP picture has " + std::to_string(header.bits) +
                " bits a pixel; those of 1, 4, 8, 24 and 32 are read");
  if (header.compression == kMasked)
    check_masks(source, header);
  else if (header.compression != kPlain)
    source.fail("the BMP picture is compressed; save it without, or as PNG");
  return header;
}

std::vector<std::uint8_t> palette_of(const PictureSource& source, const Header& header) {
  const std::size_t most = std::size_t{1} << header.bits;
  const std::size_t colours = header.colours == 0 ? most : header.colours;
  if (colours > most) source.fail("the BMP picture names more colours than its pixels can distinguish");
  std::vector<std::uint8_t> greys;
  for (std::size_t i = 0; i < colours; ++i) {
    const std::uint32_t colour = number_at(source, kInfo + header.info_size + 4 * i, 4);
    greys.push_back(grey_of(colour & 0xFFU, colour >> 8U & 0xFFU, colour >> 16U & 0xFFU));
  }
  return greys;
}

}  // namespace

GreyPicture read_bmp(const PictureSource& source) {
  const Header header = header_of(source);
  const std::int64_t rows = header.height < 0 ? -std::int64_t{header.height} : header.height;
  GreyPicture picture = source.sized(header.width, rows);
  const std::vector<std::uint8_t> palette = header.bits <= 8 ? palette_of(source, header) : std::vector<std::uint8_t>{};
  const auto width = static_cast<std::size_t>(picture.width);
  const auto height = static_cast<std::size_t>(picture.height);
  const std::size_t stride = (width * header.bits + 31) / 32 * 4;
  if (source.bytes.size() < header.pixels || source.bytes.size() - header.pixels < stride * height)
    source.fail("the BMP picture ends too early; it may have been cut");
  picture.grey.resize(width * height);
  if (header.has_alpha) picture.alpha.resize(width * height);
  for (std::size_t y = 0; y < height; ++y) {
    const auto* const row = reinterpret_cast<const unsigned char*>(source.bytes.data()) + header.pixels +
                            stride * (header.height < 0 ? y : height - 1 - y);
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t at = y * width + x;
      if (header.bits > 8) {
        const unsigned char* const p = row + x * (header.bits / 8);
        picture.grey[at] = grey_of(p[2], p[1], p[0]);
        if (header.has_alpha) picture.alpha[at] = p[3];
        continue;
      }
      const std::size_t bit = x * header.bits;
      const std::size_t index =
          static_cast<std::size_t>(row[bit / 8]) >> (8 - header.bits - bit % 8) & ((std::size_t{1} << header.bits) - 1);
      if (index >= palette.size()) source.fail("a pixel of the BMP picture has a colour that its palette lacks");
      picture.grey[at] = palette[index];
    }
  }
  return picture;
}

}  // namespace cairn::exchange
