// What differs between two maps of one frame, as a PNG: what is new in the second, what is gone, what is the same.
#pragma once

#include <filesystem>
#include <string>

#include "maps/edit/difference.hpp"

namespace cairn {

struct DifferencePicture {
  const SavedMap* a = nullptr;
  const SavedMap* b = nullptr;
  const MapDifference* difference = nullptr;  // of these two
  std::string title;
};

// Obstacles, free ground and landmarks of both, y up, about 1000 pixels on the longer side; of cells that share a pixel
// the one that differs most is shown. Throws std::runtime_error with the file and the reason when it cannot be written.
void write_difference_picture(const std::filesystem::path& file, const DifferencePicture& picture);

}  // namespace cairn
