// Small pictures as cameras write them.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

// Behind cstdio, which it needs.
#include <jpeglib.h>
#include <png.h>

namespace cairn::written_pictures {

// Grey from 0 on, brighter by a step a pixel.
inline std::vector<std::uint8_t> ramp(int width_px, int height_px) {
  std::vector<std::uint8_t> grey(static_cast<std::size_t>(width_px * height_px));
  for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = static_cast<std::uint8_t>(255 * i / grey.size());
  return grey;
}

inline std::string png(int width_px, int height_px, const std::vector<std::uint8_t>& grey) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px);
  image.height = static_cast<png_uint_32>(height_px);
  image.format = PNG_FORMAT_GRAY;
  std::string bytes(4096 + 2 * grey.size(), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, grey.data(), 0, nullptr) == 0) return {};
  bytes.resize(size);
  return bytes;
}

inline std::string jpeg(int width_px, int height_px, std::vector<std::uint8_t> grey) {
  jpeg_compress_struct out{};
  jpeg_error_mgr errors{};
  out.err = jpeg_std_error(&errors);
  jpeg_create_compress(&out);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&out, &memory, &size);
  out.image_width = static_cast<JDIMENSION>(width_px);
  out.image_height = static_cast<JDIMENSION>(height_px);
  out.input_components = 1;
  out.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&out);
  jpeg_set_quality(&out, 95, TRUE);
  jpeg_start_compress(&out, TRUE);
  while (out.next_scanline < out.image_height) {
    JSAMPROW row = grey.data() + static_cast<std::size_t>(out.next_scanline) * static_cast<std::size_t>(width_px);
    (void)jpeg_write_scanlines(&out, &row, 1);
  }
  jpeg_finish_compress(&out);
  std::string bytes(reinterpret_cast<const char*>(memory), size);
  jpeg_destroy_compress(&out);
  std::free(memory);
  return bytes;
}

}  // namespace cairn::written_pictures
