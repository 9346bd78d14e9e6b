#include "plugins/baselines/opencv_detectors/match_template.hpp"

#include <opencv2/imgproc.hpp>

#include "plugins/baselines/opencv_detectors/pictures.hpp"

namespace cairn::opencv_detectors {
namespace {

constexpr double kMaxByRounding = 1.001;

// As matchTemplate takes it: OL as bytes, gradients as floats.
cv::Mat picture_of(const Gradients& gradients, Picture picture) {
  cv::Mat x;
  cv::Mat y;
  gradients.x.convertTo(x, CV_32F);
  gradients.y.convertTo(y, CV_32F);
  cv::Mat result;
  if (picture == Picture::magnitude)
    cv::magnitude(x, y, result);
  else
    cv::merge(std::vector<cv::Mat>{x, y}, result);
  return result;
}

}  // namespace

struct MatchTemplate::Patch {
  int reach = 0;
  cv::Mat picture;
  cv::Mat mask;  // empty: all of it
};

MatchTemplate::MatchTemplate(const MatchTemplateConfig& config, std::shared_ptr<const TemplateSet> templates)
    : SearchingDetector("match_template", std::move(templates), config.tau_match), config_(config) {
  for (const LandmarkTemplate& shape : set().templates) {
    Patch& patch = patches_.emplace_back();
    patch.reach = reach_of({&shape, 1});
    if (config.picture == Picture::occupancy) {
      const auto of = std::ranges::find(set().shapes, shape.category, &LandmarkShape::category);
      patch.picture = drawn(of->contour, shape.orientation_rad, set().cell_m, patch.reach);
    } else {
      patch.picture = picture_of(gradients_of(shape, patch.reach), config.picture);
    }
    if (config.masked) patch.mask = cells_of(shape, patch.reach);
  }
}

MatchTemplate::~MatchTemplate() = default;

std::optional<std::vector<Candidate>> MatchTemplate::search(const OccupancyGrid& grid, const CellBox& centres,
                                                            const Budget& budget) {
  const CellBox box = centres.grown(reach());
  const cv::Mat whole = config_.picture == Picture::occupancy ? opencv_detectors::picture_of(grid, box)
                                                              : picture_of(gradients_of(grid, box), config_.picture);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    if (budget.exhausted()) return std::nullopt;
    const int margin = reach() - patches_[i].reach;
    const cv::Mat part = whole(cv::Rect(margin, margin, whole.cols - 2 * margin, whole.rows - 2 * margin));
    cv::Mat degrees;
    cv::matchTemplate(part, patches_[i].picture, degrees, cv::TM_CCOEFF_NORMED, patches_[i].mask);
    // Even ground has no variance to divide by.
    degrees.setTo(0.0, (degrees != degrees) | (degrees > kMaxByRounding));
    add_peaks(degrees, i, grid, centres.min, candidates);
  }
  return candidates;
}

}  // namespace cairn::opencv_detectors
