// The corners of AprilTags in a picture, by libapriltag.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "framework/contracts/camera_image.hpp"
#include "maps/landmarks/marker_id.hpp"
#include "plugins/april_tags/config.hpp"
#include "plugins/common/camera/lens.hpp"

namespace cairn::april_tags {

struct FoundTag {
  MarkerId marker;
  std::array<Pixel, 4> corners;  // as the picture has it: lower left, lower right, upper right, upper left
};

class TagFinder {
 public:
  explicit TagFinder(const Config& config);  // throws ConfigError
  ~TagFinder();
  TagFinder(const TagFinder&) = delete;
  TagFinder& operator=(const TagFinder&) = delete;

  // By rising family and number.
  [[nodiscard]] std::vector<FoundTag> find_in(const CameraImage& image);

 private:
  struct Library;

  double min_decision_margin_;
  std::unique_ptr<Library> library_;
  std::vector<std::uint8_t> grey_;  // a picture that the library may write to
};

}  // namespace cairn::april_tags
