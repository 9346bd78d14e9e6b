// Pictures in files, with a list of their stamps: a picture a line, its stamp in seconds and its file, parted by a
// blank or a comma ("1305031102.175304 rgb/1305031102.175304.png", as the TUM RGB-D benchmark has it). Lines that begin
// with # are no pictures, nor is a first line that begins with a letter.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/config/config_value.hpp"
#include "framework/contracts/robot_model.hpp"
#include "plugins/common/pictures/picture_player.hpp"

namespace cairn::pictures {

struct PictureList {
  std::filesystem::path file;  // names of pictures are relative to its folder
  int camera = 0;
  double offset_s = 0.0;  // added to its stamps
};

// In order of time. Pictures are looked for now and read later. Throws ConfigError with the line when one is not there
// or a line cannot be read, and when the robot has no such camera.
[[nodiscard]] std::vector<RecordedPicture> listed_pictures(const PictureList& list,
                                                           const std::vector<CameraModel>& cameras,
                                                           const Budget& budget = {});

}  // namespace cairn::pictures
