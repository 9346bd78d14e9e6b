#include "plugins/picture_log/picture_log.hpp"

#include <algorithm>
#include <utility>

#include "plugins/common/pictures/picture_list.hpp"

namespace cairn::picture_log {

using pictures::RecordedPicture;

void CameraPictures::describe(Fields<CameraPictures>& fields) {
  fields
      .file("list", &CameraPictures::list,
            "a picture a line: its stamp in seconds by the log's clock, and its PNG or JPEG file beside the list")
      .required = true;
  fields.integer("camera", &CameraPictures::camera, {0, 15}, "number in the robot's file, from 0");
  fields.number("offset_s", &CameraPictures::offset_s, {-1e10, 1e10}, "s",
                "added to the stamps: the log's clock less that of the pictures");
}

void Config::describe(Fields<Config>& fields) {
  fields.plugin("log", &Config::log, "sensor", "the log").required = true;
  fields.list("pictures", &Config::pictures, "pictures of a camera each").required = true;
}

std::unique_ptr<Sensor> with_pictures(std::shared_ptr<Sensor> log, const Config& config, const SensorContext& context) {
  std::vector<RecordedPicture> all;
  if (!context.wants_images) return std::make_unique<pictures::PicturePlayer>(std::move(log), all);
  for (const CameraPictures& of_camera : config.pictures) {
    std::vector<RecordedPicture> listed = pictures::listed_pictures(
        {of_camera.list, of_camera.camera, of_camera.offset_s}, context.robot.cameras, context.budget);
    all.insert(all.end(), std::make_move_iterator(listed.begin()), std::make_move_iterator(listed.end()));
  }
  std::ranges::stable_sort(all, {}, &RecordedPicture::stamp_s);
  return std::make_unique<pictures::PicturePlayer>(std::move(log), all);
}

}  // namespace cairn::picture_log
