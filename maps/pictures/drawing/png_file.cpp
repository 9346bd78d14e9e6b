// By libpng itself: OpenCV's writer would load a hundred libraries of other formats at every start.
#include "maps/pictures/drawing/png_file.hpp"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

#include "maps/base/output_file.hpp"

namespace cairn::pictures {

namespace {

// A map or a text named by mistake is not drawn over; a link is replaced itself.
void check_may_be_replaced(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(file, error)) ||
      std::filesystem::file_size(file, error) == 0)
    return;
  std::array<png_byte, 8> beginning{};
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(beginning.data()), beginning.size());
  if (png_sig_cmp(beginning.data(), 0, beginning.size()) != 0)
    throw std::runtime_error(file.string() + ": is there already and is not PNG: it is left as it is");
}

struct CloseStream {
  void operator()(std::FILE* stream) const { std::fclose(stream); }
};

std::string bytes_of(png_image& image, std::span<const std::uint8_t> rgb) {
  char* bytes = nullptr;
  std::size_t size = 0;
  std::unique_ptr<std::FILE, CloseStream> stream(::open_memstream(&bytes, &size));
  const bool is_written = stream && png_image_write_to_stdio(&image, stream.get(), 0, rgb.data(), 0, nullptr) != 0;
  stream.reset();  // sets bytes and size
  const std::unique_ptr<char, decltype(&std::free)> owned(bytes, &std::free);
  if (!is_written) throw std::runtime_error(std::string("the picture cannot be made: ") + image.message);
  return {owned.get(), size};
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
  write_file(file, bytes_of(image, rgb));
}

}  // namespace cairn::pictures
