#include "plugins/baselines/opencv_detectors/chamfer.hpp"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "plugins/baselines/opencv_detectors/pictures.hpp"

namespace cairn::opencv_detectors {

struct Chamfer::Points {
  int reach = 0;
  cv::Mat weights;  // 1 / points on each of them, CV_32F
};

Chamfer::Chamfer(const ChamferConfig& config, std::shared_ptr<const TemplateSet> templates)
    : SearchingDetector("chamfer", std::move(templates), config.tau_match), config_(config) {
  for (const LandmarkTemplate& shape : set().templates) {
    Points& points = points_.emplace_back();
    points.reach = reach_of({&shape, 1});
    const cv::Mat edges = edges_of(gradients_of(shape, points.reach), config.edge_low, config.edge_high);
    const int count = cv::countNonZero(edges);
    if (count == 0)
      throw std::invalid_argument("a template of category \"" + shape.category + "\" has no edge above edge_high");
    edges.convertTo(points.weights, CV_32F, 1.0 / (255.0 * count));
  }
}

Chamfer::~Chamfer() = default;

std::optional<std::vector<Candidate>> Chamfer::search(const OccupancyGrid& grid, const CellBox& centres,
                                                      const Budget& budget) {
  // Edges beyond the templates' reach are near to their points too.
  const int beyond = static_cast<int>(std::ceil(config_.truncation_m / set().cell_m)) + 1;
  const CellBox box = centres.grown(reach() + beyond);
  const cv::Mat edges = edges_of(gradients_of(grid, box), config_.edge_low, config_.edge_high);
  if (cv::countNonZero(edges) == 0) return std::vector<Candidate>{};
  cv::Mat off;
  cv::distanceTransform(255 - edges, off, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  off = cv::min(off * (set().cell_m / config_.truncation_m), 1.0);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (budget.exhausted()) return std::nullopt;
    const int margin = reach() + beyond - points_[i].reach;
    const cv::Mat part = off(cv::Rect(margin, margin, off.cols - 2 * margin, off.rows - 2 * margin));
    cv::Mat mean;
    cv::matchTemplate(part, points_[i].weights, mean, cv::TM_CCORR);
    const cv::Mat degrees = 1.0 - mean;
    add_peaks(degrees, i, grid, centres.min, candidates);
  }
  return candidates;
}

}  // namespace cairn::opencv_detectors
