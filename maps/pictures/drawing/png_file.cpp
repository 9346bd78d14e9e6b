// By libpng itself: OpenCV's writer would load a hundred libraries of other formats at every start.
#include "maps/pictures/drawing/png_file.hpp"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <fstream>
#include <stdexcept>

namespace cairn::pictures {

namespace {

// A map or a text named by mistake is not drawn over.
void check_may_be_replaced(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error) || std::filesystem::file_size(file, error) == 0) return;
  std::array<png_byte, 8> beginning{};
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(beginning.data()), beginning.size());
  if (png_sig_cmp(beginning.data(), 0, beginning.size()) != 0)
    throw std::runtime_error(file.string() + ": is there already and is not PNG: it is left as it is");
}

}  // namespace

void write_png_file(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> rgb) {
  if (width <= 0 || height <= 0 || rgb.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3)
    throw std::invalid_argument(
        fmt::format("write_png_file: {} bytes are no picture of {} x {}", rgb.size(), width, height));
  check_may_be_replaced(file);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, file.c_str(), 0, rgb.data(), 0, nullptr) == 0)
    throw std::runtime_error(file.string() + ": cannot be written: " + image.message);
}

}  // namespace cairn::pictures
