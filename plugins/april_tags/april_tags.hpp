// The module `april_tags`: from pictures to sightings of AprilTags.
#pragma once

#include "framework/contracts/marker_detector.hpp"
#include "framework/contracts/optional/marker_families.hpp"
#include "plugins/april_tags/config.hpp"
#include "plugins/april_tags/tag_finder.hpp"

namespace cairn::april_tags {

class AprilTags : public MarkerDetector, public MarkerFamilies {
 public:
  // Throws ConfigError.
  AprilTags(const Config& config, std::vector<CameraModel> cameras);

  std::vector<MarkerSighting> detect(std::span<const CameraImage> images, const Budget& budget) override;
  [[nodiscard]] std::vector<MarkerFamily> families() const override { return config_.families; }

 private:
  void add_sightings(const CameraImage& image, std::vector<MarkerSighting>& sightings);

  Config config_;
  std::vector<CameraModel> cameras_;
  TagFinder finder_;
};

}  // namespace cairn::april_tags
