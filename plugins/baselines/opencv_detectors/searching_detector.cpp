#include "plugins/baselines/opencv_detectors/searching_detector.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <tuple>

namespace cairn::opencv_detectors {
namespace {

bool is_better(const Candidate& a, const Candidate& b) {
  return std::tuple(-a.degree, a.index, a.at_m.y(), a.at_m.x()) <
         std::tuple(-b.degree, b.index, b.at_m.y(), b.at_m.x());
}

// The best of each orientation of each category; candidates come best first.
std::vector<TemplateDegree> templates_of(const TemplateSet& set, const Strongest& found) {
  std::vector<TemplateDegree> templates;
  const auto add = [&](const Candidate& candidate) {
    const std::string& category = set.templates[candidate.index].category;
    if (std::ranges::none_of(templates, [&](const TemplateDegree& known) {
          return known.category == category && known.orientation_rad == candidate.orientation_rad;
        }))
      templates.push_back({category, candidate.orientation_rad, candidate.degree});
  };
  add(found.best);
  for (const Candidate& candidate : found.weaker) add(candidate);
  return templates;
}

}  // namespace

std::vector<Strongest> strongest_of(std::vector<Candidate> candidates, double apart_m) {
  std::ranges::sort(candidates, is_better);
  std::vector<Strongest> strongest;
  for (const Candidate& candidate : candidates) {
    const auto stronger = std::ranges::find_if(
        strongest, [&](const Strongest& s) { return (s.best.at_m - candidate.at_m).norm() < apart_m; });
    if (stronger == strongest.end())
      strongest.push_back({candidate, {}});
    else
      stronger->weaker.push_back(candidate);
  }
  return strongest;
}

std::vector<Cell> peaks_of(const cv::Mat& degrees, Cell first, double tau) {
  cv::Mat highest;
  cv::dilate(degrees, highest, cv::Mat());
  std::vector<Cell> peaks;
  for (int y = 0; y < degrees.rows; ++y)
    for (int x = 0; x < degrees.cols; ++x) {
      const float degree = degrees.at<float>(y, x);
      if (degree > tau && degree >= highest.at<float>(y, x)) peaks.push_back(first + Cell{x, y});
    }
  return peaks;
}

void SearchingDetector::add_peaks(const cv::Mat& degrees, std::size_t index, const OccupancyGrid& grid, Cell first,
                                  std::vector<Candidate>& candidates) const {
  for (const Cell at : peaks_of(degrees, first, tau_match_)) {
    const Cell pixel = at - first;
    const double degree = std::min(1.0, static_cast<double>(degrees.at<float>(pixel.y, pixel.x)));
    candidates.push_back({grid.centre_of(at), index, set().templates[index].orientation_rad, degree});
  }
}

SearchingDetector::SearchingDetector(const std::string& name, std::shared_ptr<const TemplateSet> templates,
                                     double tau_match)
    : templates_(usable(std::move(templates), name)), tau_match_(tau_match), reach_(reach_of(templates_->templates)) {}

DetectionReport SearchingDetector::detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) {
  check_cell_size(*templates_, grid.cell_m());
  waiting_ = united(waiting_, intersected(changes.box(), grid.bounds()));
  if (waiting_.empty() || budget.iterations < 1 || budget.exhausted()) return {};
  const CellBox centres = intersected(waiting_.grown(reach_), grid.bounds());
  std::optional<std::vector<Candidate>> candidates = search(grid, centres, budget);
  if (!candidates) return {};
  waiting_ = {};
  DetectionReport report;
  for (const Strongest& found : strongest_of(std::move(*candidates), templates_->smallest_diameter_m()))
    report.matchings.push_back(matching_of(found));
  if (report.matchings.empty()) report.matchings.emplace_back();
  for (Matching& matching : report.matchings) {
    matching.fits_above = tau_match_;
    matching.region_cells = centres.width() * centres.height();
    matching.region_centre_m = 0.5 * (grid.centre_of(centres.min) + grid.centre_of(centres.max - Cell{1, 1}));
  }
  return report;
}

Matching SearchingDetector::matching_of(const Strongest& found) const {
  const LandmarkTemplate& shape = templates_->templates[found.best.index];
  Matching matching;
  matching.detection = Detection{shape.category,
                                 {found.best.at_m.x(), found.best.at_m.y(), wrap_angle(found.best.orientation_rad)},
                                 found.best.degree,
                                 templates_of(*templates_, found)};
  for (const LandmarkShape& of : templates_->shapes) {
    const auto best = std::ranges::find(matching.detection->templates, of.category, &TemplateDegree::category);
    if (best == matching.detection->templates.end()) continue;
    matching.degrees.push_back({of.category, best->degree, best->orientation_rad, found.best.at_m});
  }
  return matching;
}

}  // namespace cairn::opencv_detectors
