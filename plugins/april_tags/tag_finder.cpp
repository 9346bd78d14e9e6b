#include "plugins/april_tags/tag_finder.hpp"

#include <apriltag/apriltag.h>

#include <algorithm>
#include <tuple>

#include "plugins/common/camera/tag_codes.hpp"

namespace cairn::april_tags {
namespace {

// The tables for two bits take a second and 100 MB with the largest family.
constexpr int kCorrectedBits = 1;

// A square may be printed or hung turned by quarters; the library's order goes by the print. It counts pixels from
// their corners.
std::array<Pixel, 4> upright_corners(const apriltag_detection_t& detection) {
  const auto lower_left = [&](int i) { return detection.p[i][1] - detection.p[i][0]; };
  int first = 0;
  for (int i = 1; i < 4; ++i)
    if (lower_left(i) > lower_left(first)) first = i;
  std::array<Pixel, 4> corners;
  for (int i = 0; i < 4; ++i) {
    const double* const corner = detection.p[(first + i) % 4];
    corners[static_cast<std::size_t>(i)] = {corner[0] - 0.5, corner[1] - 0.5};
  }
  return corners;
}

}  // namespace

struct TagFinder::Library {
  std::vector<std::pair<MarkerFamily, TagCodes>> families;
  std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector{apriltag_detector_create(),
                                                                                apriltag_detector_destroy};
};

TagFinder::TagFinder(const Config& config)
    : min_decision_margin_(config.min_decision_margin), library_(std::make_unique<Library>()) {
  apriltag_detector_t* const detector = library_->detector.get();
  for (const MarkerFamily family : config.families) {
    library_->families.emplace_back(family, tag_codes_of(family));
    apriltag_detector_add_family_bits(detector, library_->families.back().second.get(), kCorrectedBits);
  }
  detector->quad_decimate = static_cast<float>(config.decimate);
  detector->nthreads = config.threads;
}

TagFinder::~TagFinder() = default;

std::vector<FoundTag> TagFinder::find_in(const CameraImage& image) {
  grey_ = *image.grey;
  image_u8_t view = {image.width_px, image.height_px, image.width_px, grey_.data()};
  const std::unique_ptr<zarray_t, void (*)(zarray_t*)> detections(
      apriltag_detector_detect(library_->detector.get(), &view), apriltag_detections_destroy);
  std::vector<FoundTag> found;
  found.reserve(static_cast<std::size_t>(zarray_size(detections.get())));
  for (int i = 0; i < zarray_size(detections.get()); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(detections.get(), i, static_cast<void*>(&detection));
    if (detection->decision_margin < min_decision_margin_) continue;
    const auto family = std::ranges::find_if(
        library_->families, [&](const auto& known) { return known.second.get() == detection->family; });
    found.push_back({{family->first, detection->id}, upright_corners(*detection)});
  }
  std::ranges::sort(found, [](const FoundTag& a, const FoundTag& b) {
    return std::tuple(a.marker, a.corners[0].x(), a.corners[0].y()) <
           std::tuple(b.marker, b.corners[0].x(), b.corners[0].y());
  });
  return found;
}

}  // namespace cairn::april_tags
