// The paper's landmark detector: OG2 says when and where, template matching on the gradients of OG1
// says what (docs/method.md 3 to 7; paper section 3).
#pragma once

#include <memory>

#include "framework/contracts/detector.hpp"
#include "plugins/template_matcher/classify.hpp"
#include "plugins/template_matcher/config.hpp"
#include "plugins/template_matcher/fast_match.hpp"
#include "plugins/template_matcher/hidden_part.hpp"
#include "plugins/template_matcher/refine.hpp"
#include "plugins/template_matcher/region.hpp"
#include "plugins/template_matcher/trigger.hpp"

namespace cairn::template_matcher {

// Runs at most budget.iterations matchings a call; a trigger that a budget cut off fires again with
// the next change. Not thread-safe.
class TemplateMatcher : public Detector {
 public:
  // Throws std::invalid_argument without templates, on a template without cells, and when
  // coarse_cells > floor(d_min / l) (docs/method.md 3).
  TemplateMatcher(const Config& config, std::shared_ptr<const TemplateSet> templates);

  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) override;
  [[nodiscard]] const CoarseGrid* coarse_grid() const override { return &coarse_; }

 private:
  [[nodiscard]] Matching match(const OccupancyGrid& grid, Cell trigger);
  // Of every template that matters the best place: those that may be above tau_match and, when all degrees
  // are asked for, the best of each category.
  [[nodiscard]] std::vector<TemplateMatch> search(std::span<const CellSpan> region);
  [[nodiscard]] PlaceInCell place_of(std::size_t index, Cell at, bool between, const OccupancyGrid& grid) const;
  // What is hidden weighed, and between the cells.
  [[nodiscard]] std::vector<TemplateMatch> weighed(std::vector<TemplateMatch> matches, const OccupancyGrid& grid) const;
  [[nodiscard]] std::vector<TemplateMatch> refined(std::vector<TemplateMatch> matches, const OccupancyGrid& grid) const;
  void complete_neighbours(std::size_t index, std::vector<TemplateMatch>& matches);
  [[nodiscard]] std::optional<Detection> detection_of(const std::vector<TemplateMatch>& matches,
                                                      std::vector<TemplateMatch> on_cells, const OccupancyGrid& grid);

  Config config_;
  std::shared_ptr<const TemplateSet> templates_;
  ScoreRule rule_;
  RegionReach reach_;
  int template_reach_;
  CoarseGrid coarse_;
  Trigger trigger_;
  GradientField field_;  // of the current region
  FastMatcher matcher_;
  std::vector<std::int32_t> ceilings_;         // one a template: from there on below every threshold
  std::vector<std::int32_t> hidden_ceilings_;  // the same: from there on what is hidden is not weighed
  HiddenParts hidden_;
  OrientationNeighbours neighbours_;
  std::vector<Cell> touched_;  // kept for its memory only
};

}  // namespace cairn::template_matcher
