// cv::matchTemplate: the normalised correlation coefficient of every rotated template with every place.
#pragma once

#include "plugins/baselines/opencv_detectors/config.hpp"
#include "plugins/baselines/opencv_detectors/searching_detector.hpp"

namespace cairn::opencv_detectors {

class MatchTemplate : public SearchingDetector {
 public:
  MatchTemplate(const MatchTemplateConfig& config, std::shared_ptr<const TemplateSet> templates);
  ~MatchTemplate() override;

 private:
  std::optional<std::vector<Candidate>> search(const OccupancyGrid& grid, const CellBox& centres,
                                               const Budget& budget) override;

  MatchTemplateConfig config_;
  struct Patch;
  std::vector<Patch> patches_;  // one a template
};

}  // namespace cairn::opencv_detectors
