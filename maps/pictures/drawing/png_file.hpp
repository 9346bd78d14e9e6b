// Writes RGB pixels as a PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace cairn::pictures {

// rgb: 3 bytes a pixel, row by row from above. The same pixels give the same bytes. Throws
// std::runtime_error with the file and the reason.
void write_png_file(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace cairn::pictures
