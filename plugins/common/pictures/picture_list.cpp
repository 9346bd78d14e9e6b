#include "plugins/common/pictures/picture_list.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "maps/base/text.hpp"
#include "plugins/common/logs/log_line.hpp"
#include "plugins/common/logs/log_text.hpp"
#include "plugins/common/pictures/grey_picture.hpp"

namespace cairn::pictures {
namespace {

using log_common::LogLine;

constexpr std::uintmax_t kMaxFile = std::uintmax_t{64} << 20U;

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw std::runtime_error("it cannot be read");
  return bytes;
}

CameraImage read_picture(const std::filesystem::path& file, const SourcePlace& place, int camera,
                         const CameraModel& model) {
  try {
    CameraImage image = unpacked(bytes_of(file));
    image.camera = camera;
    check_size(image.width_px, image.height_px, model);
    return image;
  } catch (const std::runtime_error& error) {
    throw ConfigError(place, file.filename().string() + ": " + error.what());
  }
}

RecordedPicture picture_in(const LogLine& line, const PictureList& list, const CameraModel& model) {
  if (line.size() != 2)
    throw ConfigError(line.place(0),
                      "a picture is a stamp and a file, and the line has " + counted(line.size(), "word"));
  RecordedPicture picture;
  picture.stamp_s = line.finite(0, "stamp") + list.offset_s;
  const std::filesystem::path file = list.file.parent_path() / line.word(1);
  const SourcePlace place = line.place(1);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))  // a pipe would be waited for without end
    throw ConfigError(place, "no such picture: " + file.string());
  if (std::filesystem::file_size(file, error) > kMaxFile)
    throw ConfigError(place, "a file of more than 64 MiB is no picture of a camera: " + file.string());
  picture.read = [file, place, camera = list.camera, model] { return read_picture(file, place, camera, model); };
  return picture;
}

bool is_title(std::string_view text, int line) {
  return line == 1 && std::isalpha(static_cast<unsigned char>(text.front())) != 0;
}

const CameraModel& camera_in(const PictureList& list, const std::vector<CameraModel>& cameras) {
  try {
    return camera_of(list.camera, cameras);
  } catch (const std::runtime_error& error) {
    throw ConfigError({list.file.string(), 0, 0}, error.what());
  }
}

}  // namespace

std::vector<RecordedPicture> listed_pictures(const PictureList& list, const std::vector<CameraModel>& cameras,
                                             const Budget& budget) {
  const CameraModel& camera = camera_in(list, cameras);
  std::vector<RecordedPicture> pictures;
  log_common::LogText text(list.file, budget);
  LogLine line(text.name());
  std::string_view content;
  while (text.next(content)) {
    const std::string_view said = trimmed(content);
    if (said.empty() || said.front() == '#' || is_title(said, text.line_number())) continue;
    line.cut(content, text.line_number(),
             said.find(',') == std::string_view::npos ? std::optional<char>() : std::optional(','));
    pictures.push_back(picture_in(line, list, camera));
  }
  if (pictures.empty()) throw ConfigError({list.file.string(), 0, 0}, "the list names no picture");
  std::ranges::stable_sort(pictures, {}, &RecordedPicture::stamp_s);
  return pictures;
}

}  // namespace cairn::pictures
