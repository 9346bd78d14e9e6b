#include "maps/exchange/grids/grey_picture.hpp"

#include <png.h>

#include <random>

#include "tests/maps/exchange/exchange_fixture.hpp"

namespace cairn {
namespace {

GreyPicture parse(const std::string& bytes) {
  return parse_grey_picture(bytes, "map.in");
}
std::string refusal(const std::string& bytes) {
  return refusal_of([](const std::string& b, const std::string& name) { return parse_grey_picture(b, name); }, bytes);
}

std::vector<std::uint8_t> greys(std::initializer_list<int> values) {
  return {values.begin(), values.end()};
}

struct Picture {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t channels = 1;
  std::vector<std::uint8_t> bytes;  // grey, or red, green, blue, alpha
};

Picture random_picture(std::size_t width, std::size_t height, std::size_t channels, std::mt19937_64& random) {
  Picture picture{width, height, channels, std::vector<std::uint8_t>(width * height * channels)};
  for (std::uint8_t& byte : picture.bytes) byte = static_cast<std::uint8_t>(random());
  return picture;
}

std::string pgm_of(const Picture& picture) {
  return "P5\n# a comment\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n255\n" +
         std::string(picture.bytes.begin(), picture.bytes.end());
}

std::string png_of(const Picture& picture, png_uint_32 format) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = format;
  png_alloc_size_t size = 1 << 20;
  std::string bytes(size, '\0');
  EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.bytes.data(), 0, nullptr), 0);
  bytes.resize(size);
  return bytes;
}

std::string little(std::uint64_t value, int size) {
  std::string bytes;
  for (; size > 0; --size, value >>= 8U) bytes += static_cast<char>(value & 0xFFU);
  return bytes;
}

// Grey as a palette of 256, colours as 24 bits, with alpha as masked 32 bits.
std::string bmp_of(const Picture& picture) {
  const std::size_t info = picture.channels == 4 ? 56 : 40;
  const std::size_t palette = picture.channels == 1 ? 1024 : 0;
  std::string bmp = "BM" + little(0, 8) + little(14 + info + palette, 4) + little(info, 4) + little(picture.width, 4) +
                    little(picture.height, 4) + little(1, 2) + little(8 * picture.channels, 2) +
                    little(picture.channels == 4 ? 3 : 0, 4) + little(0, 20);
  if (picture.channels == 4)
    for (const std::uint64_t mask : {0x00FF0000U, 0x0000FF00U, 0x000000FFU, 0xFF000000U}) bmp += little(mask, 4);
  if (picture.channels == 1)
    for (std::uint64_t grey = 0; grey < 256; ++grey) bmp += little(grey * 0x010101U, 4);
  for (std::size_t y = picture.height; y-- > 0;) {
    std::string row;
    for (std::size_t x = 0; x < picture.width; ++x) {
      const std::uint8_t* const p = &picture.bytes[(y * picture.width + x) * picture.channels];
      if (picture.channels == 1) row += static_cast<char>(p[0]);
      if (picture.channels >= 3) row += {static_cast<char>(p[2]), static_cast<char>(p[1]), static_cast<char>(p[0])};
      if (picture.channels == 4) row += static_cast<char>(p[3]);
    }
    bmp += row + std::string((4 - row.size() % 4) % 4, '\0');
  }
  return bmp;
}

TEST(GreyPicture, GreysReadBackInEveryFormatAndWidth) {
  std::mt19937_64 random(5);
  for (std::size_t width = 1; width <= 9; ++width) {
    const Picture written = random_picture(width, 3, 1, random);
    for (const std::string& bytes : {pgm_of(written), png_of(written, PNG_FORMAT_GRAY), bmp_of(written)}) {
      const GreyPicture read = parse(bytes);
      EXPECT_EQ(read.width, static_cast<int>(width));
      EXPECT_EQ(read.height, 3);
      EXPECT_EQ(read.grey, written.bytes) << bytes.substr(0, 4);
      EXPECT_TRUE(read.alpha.empty());
    }
  }
}

TEST(GreyPicture, ColoursBecomeTheirMeanAndAlphaIsKept) {
  std::mt19937_64 random(11);
  for (const std::size_t channels : {3U, 4U}) {
    const Picture written = random_picture(5, 4, channels, random);
    for (const std::string& bytes :
         {png_of(written, channels == 3 ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA), bmp_of(written)}) {
      const GreyPicture read = parse(bytes);
      ASSERT_EQ(read.grey.size(), 20U);
      ASSERT_EQ(read.alpha.size(), channels == 4 ? 20U : 0U);
      for (std::size_t i = 0; i < 20; ++i) {
        const std::uint8_t* const p = &written.bytes[i * channels];
        EXPECT_EQ(read.grey[i], std::lround((p[0] + p[1] + p[2]) / 3.0));
        if (channels == 4) {
          EXPECT_EQ(read.alpha[i], p[3]);
        }
      }
    }
  }
}

TEST(GreyPicture, SixteenBitsAreScaledToEight) {
  EXPECT_EQ(parse("P5 3 1 65535\n" + std::string("\0\0\xCD\xCD\xFF\xFF", 6)).grey, greys({0, 205, 255}));
}

TEST(GreyPicture, PgmOfTextHasCommentsAndItsOwnWhite) {
  const GreyPicture read = parse("P2 # by hand\n# size\n3 2\n4\n0 1 2\n3 4 # the last\n0");
  EXPECT_EQ(read.grey, greys({0, 64, 128, 191, 255, 0}));
  EXPECT_EQ(read.width, 3);
}

TEST(GreyPicture, BmpOfFewColoursAndTopRowFirst) {
  // 3 x 2 pixels of one bit: palette red and white; the second row is stored last as the height is negative.
  std::string bmp("BM\0\0\0\0\0\0\0\0\x3E\0\0\0\x28\0\0\0\x03\0\0\0\xFE\xFF\xFF\xFF\x01\0\x01\0", 30);
  bmp += std::string(24, '\0') + std::string("\0\0\xFF\0\xFF\xFF\xFF\0", 8) + std::string("\xA0\0\0\0\x40\0\0\0", 8);
  EXPECT_EQ(parse(bmp).grey, greys({255, 85, 255, 85, 255, 85}));
}

TEST(GreyPicture, WhatIsNoPictureIsRefused) {
  for (const char* bytes : {"", "P6 1 1 255\nabc", "GIF89a", "\xFF\xD8\xFF\xE0"})
    EXPECT_EQ(refusal(bytes), " is not a picture in PGM, PNG or BMP");
  EXPECT_EQ(refusal("P5\n3 x\n255\n"), "2:3: the height \"x\" is not a whole number of 1 to 131072");
  EXPECT_EQ(refusal("P5\n3"), "2:2: the height is missing; the file ends here, it may have been cut");
  EXPECT_EQ(refusal("P5\n3 2\n0\n"), "3:1: the value of white \"0\" is not a whole number of 1 to 65535");
  EXPECT_EQ(refusal("P5 3 2 255\nabcde"), " holds 5 bytes of pixels, too few for 3 x 2; it may have been cut");
  EXPECT_EQ(refusal("P2 2 1 9\n5 10"), "2:3: a pixel \"10\" is not a whole number of 0 to 9");
  EXPECT_EQ(refusal("BM"), " the BMP picture ends too early; it may have been cut");
  EXPECT_THAT(refusal("\x89PNG\r\n"), testing::StartsWith(" is not a PNG picture that can be read: "));
}

TEST(GreyPicture, WhatIsTooLargeIsRefusedByItsHeader) {
  const std::string most = " pixels, possible are 1 to 131072 a side and 268435456 in all";
  EXPECT_EQ(refusal("P5 131072 131072 255\n"), " the picture has 131072 x 131072" + most);
  std::string png = png_of({1, 1, 1, {0}}, PNG_FORMAT_GRAY);
  png.replace(16, 8, std::string("\0\0\xFF\xFF\0\0\xFF\xFF", 8));
  png.replace(29, 4, std::string("\x93\x6E\x86\x8C", 4));  // its checksum
  EXPECT_EQ(refusal(png), " the picture has 65535 x 65535" + most);
  EXPECT_EQ(refusal_of([](const std::string& b, const std::string& name) { return parse_grey_picture(b, name, 5); },
                       "P5 3 2 255\nabcdef"),
            " the picture has 3 x 2 pixels, possible are 1 to 131072 a side and 5 in all");
}

// Cut anywhere, or with any byte changed: a picture or a refusal, whatever the format.
TEST(GreyPicture, DamagedPicturesAreReadOrRefused) {
  std::mt19937_64 random(3);
  int refused = 0;
  for (int i = 0; i < 1200; ++i) {
    const Picture written = random_picture(6, 5, 1, random);
    std::string bytes = i % 3 == 0 ? pgm_of(written) : i % 3 == 1 ? png_of(written, PNG_FORMAT_GRAY) : bmp_of(written);
    const bool is_cut = random() % 2 == 0;
    const std::size_t at = random() % (is_cut ? bytes.size() : std::min<std::size_t>(bytes.size(), 60));
    if (is_cut)
      bytes.resize(at);
    else
      bytes[at] = static_cast<char>(random());
    try {
      const GreyPicture read = parse_grey_picture(bytes, "map.in", 1 << 20);
      EXPECT_EQ(read.grey.size(), static_cast<std::size_t>(read.width) * static_cast<std::size_t>(read.height));
    } catch (const ExchangeError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 600);
}

}  // namespace
}  // namespace cairn
