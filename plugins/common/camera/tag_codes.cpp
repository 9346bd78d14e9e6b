#include "plugins/common/camera/tag_codes.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagStandard41h12.h>

namespace cairn {

TagCodes tag_codes_of(MarkerFamily family) {
  switch (family) {
    case MarkerFamily::tag25h9:
      return {tag25h9_create(), tag25h9_destroy};
    case MarkerFamily::tagStandard41h12:
      return {tagStandard41h12_create(), tagStandard41h12_destroy};
    case MarkerFamily::tag36h11:
      break;
  }
  return {tag36h11_create(), tag36h11_destroy};
}

}  // namespace cairn
