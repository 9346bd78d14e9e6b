// What the OpenCV detectors share: they search all ground that has changed and keep the strongest of what
// stands in each other's way.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/detector.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cv {
class Mat;
}

namespace cairn::opencv_detectors {

// A place where a template fits.
struct Candidate {
  Point at_m{0.0, 0.0};
  std::size_t index = 0;  // of the template
  double orientation_rad = 0.0;
  double degree = 0.0;
};

// Candidates that give way to none of the others, the best first. Of two that are nearer than apart_m the
// better one stays; of equal ones the earlier template, then the lower and the left one.
struct Strongest {
  Candidate best;
  std::vector<Candidate> weaker;  // that gave way to it, best first
};
[[nodiscard]] std::vector<Strongest> strongest_of(std::vector<Candidate> candidates, double apart_m);

// The peaks of a picture of degrees (CV_32F) above tau: no lower than all eight neighbours. Its first
// pixel is the cell `first`.
[[nodiscard]] std::vector<Cell> peaks_of(const cv::Mat& degrees, Cell first, double tau);

// Not thread-safe. Each call is one search, for which budget.iterations must be at least 1; it gives a
// matching for every landmark found, or one that found nothing.
class SearchingDetector : public Detector {
 public:
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) final;

 protected:
  // Throws std::invalid_argument without templates and on a template without cells.
  SearchingDetector(const std::string& name, std::shared_ptr<const TemplateSet> templates, double tau_match);

  // Where templates fit above tau_match when centred on cells of the box. None when the budget ended it,
  // which is asked before each template: the next change makes up for it.
  [[nodiscard]] virtual std::optional<std::vector<Candidate>> search(const OccupancyGrid& grid, const CellBox& centres,
                                                                     const Budget& budget) = 0;

  // A candidate at each of peaks_of(degrees, first, tau_match()).
  void add_peaks(const cv::Mat& degrees, std::size_t index, const OccupancyGrid& grid, Cell first,
                 std::vector<Candidate>& candidates) const;

  [[nodiscard]] const TemplateSet& set() const { return *templates_; }
  [[nodiscard]] double tau_match() const { return tau_match_; }
  [[nodiscard]] int reach() const { return reach_; }

 private:
  [[nodiscard]] Matching matching_of(const Strongest& found) const;

  std::shared_ptr<const TemplateSet> templates_;
  double tau_match_;
  int reach_;
  CellBox waiting_;  // changed, not searched yet
};

}  // namespace cairn::opencv_detectors
