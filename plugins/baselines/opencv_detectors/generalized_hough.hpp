// cv::GeneralizedHoughGuil: pairs of edge points vote for where a rotated template stands.
#pragma once

#include "plugins/baselines/opencv_detectors/config.hpp"
#include "plugins/baselines/opencv_detectors/searching_detector.hpp"

namespace cairn::opencv_detectors {

// Degree: the votes, as a share of those that the template gets on its own picture.
class GeneralizedHough : public SearchingDetector {
 public:
  // Throws std::invalid_argument too when a template gets no votes on its own picture.
  GeneralizedHough(const HoughConfig& config, std::shared_ptr<const TemplateSet> templates);
  ~GeneralizedHough() override;

 private:
  std::optional<std::vector<Candidate>> search(const OccupancyGrid& grid, const CellBox& centres,
                                               const Budget& budget) override;

  HoughConfig config_;
  struct Voting;
  std::vector<Voting> votings_;  // one a template
};

}  // namespace cairn::opencv_detectors
