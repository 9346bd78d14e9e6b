// Chamfer matching: how near the edge points of every rotated template are to the edges of the map, by
// cv::distanceTransform.
#pragma once

#include "plugins/baselines/opencv_detectors/config.hpp"
#include "plugins/baselines/opencv_detectors/searching_detector.hpp"

namespace cairn::opencv_detectors {

// Degree: 1 - mean / truncation, of the edge points' distances cut off at the truncation.
class Chamfer : public SearchingDetector {
 public:
  // Throws std::invalid_argument too when a template has no edge at these thresholds.
  Chamfer(const ChamferConfig& config, std::shared_ptr<const TemplateSet> templates);
  ~Chamfer() override;

 private:
  std::optional<std::vector<Candidate>> search(const OccupancyGrid& grid, const CellBox& centres,
                                               const Budget& budget) override;

  ChamferConfig config_;
  struct Points;
  std::vector<Points> points_;  // one a template
};

}  // namespace cairn::opencv_detectors
