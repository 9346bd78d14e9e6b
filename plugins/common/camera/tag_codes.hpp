// The codes of a family of AprilTags, as libapriltag has them: what draws tags and what finds them share one source.
#pragma once

#include <memory>

#include "maps/landmarks/marker_id.hpp"

struct apriltag_family;

namespace cairn {

using TagCodes = std::unique_ptr<apriltag_family, void (*)(apriltag_family*)>;

[[nodiscard]] TagCodes tag_codes_of(MarkerFamily family);

}  // namespace cairn
