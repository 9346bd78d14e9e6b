// What the tests of pictures share: a folder to draw into, and a reader of what was drawn.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "maps/pictures/drawing/colours.hpp"

namespace cairn {

using pictures::Colour;
using pictures::Pixel;

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

namespace fs = std::filesystem;

inline std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Png {
  int width = 0;
  int height = 0;
  std::vector<Colour> pixels;

  [[nodiscard]] Colour at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  [[nodiscard]] long count(Colour colour) const { return std::ranges::count(pixels, colour); }
  // Mean place of the pixels of this colour.
  [[nodiscard]] Pixel centre_of(Colour colour) const {
    Pixel sum(0, 0);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (at(x, y) == colour) sum += Pixel(x, y);
    return sum / static_cast<double>(count(colour));
  }
};

inline Png read_png(const fs::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&image, file.c_str()), 0) << image.message;
  image.format = PNG_FORMAT_RGB;
  Png png{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  png.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  EXPECT_NE(png_image_finish_read(&image, nullptr, png.pixels.data(), 0, nullptr), 0) << image.message;
  return png;
}

class Pictures : public testing::Test {
 protected:
  Pictures() {
    std::string pattern = (fs::temp_directory_path() / "picture_test_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~Pictures() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path file(const char* name = "map.png") const { return folder_ / name; }

  fs::path folder_;
};

}  // namespace cairn
