#include "plugins/simulated_robot/camera/tag_pattern.hpp"

#include <apriltag/apriltag.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "plugins/common/camera/tag_codes.hpp"

namespace cairn {
TagPattern pattern_of(const MarkerId& marker) {
  const TagCodes family = tag_codes_of(marker.family);
  if (marker.number < 0 || marker.number >= static_cast<int>(family->ncodes))
    throw std::invalid_argument("marker family " + std::string(name_of(marker.family)) + " has no number " +
                                std::to_string(marker.number));
  const std::unique_ptr<image_u8_t, void (*)(image_u8_t*)> image(apriltag_to_image(family.get(), marker.number),
                                                                 image_u8_destroy);
  TagPattern pattern{family->total_width, family->width_at_border, {}};
  pattern.white.reserve(static_cast<std::size_t>(pattern.cells) * static_cast<std::size_t>(pattern.cells));
  for (int row = 0; row < pattern.cells; ++row)
    for (int column = 0; column < pattern.cells; ++column)
      pattern.white.push_back(image->buf[row * image->stride + column] != 0);
  return pattern;
}

}  // namespace cairn
