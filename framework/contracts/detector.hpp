// Detector: recognises landmarks in OG1 (paper section 3).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "framework/contracts/module_context.hpp"
#include "maps/grid/coarse_grid.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn {

struct Detection {
  std::string category;
  Pose2 T_map_landmark;
  double degree = 0.0;
  std::vector<TemplateDegree> templates;  // all above tau_match, best first
};

struct CategoryDegree {
  std::string category;
  double degree = 0.0;
  double orientation_rad = 0.0;
  Point at_m{0.0, 0.0};
  bool fits = true;  // false: below the detector's own threshold, for charts only
};

// One run of the template matcher: where, what it found of every category, and the class if any.
struct Matching {
  Cell trigger;          // coarse cell
  int region_cells = 0;  // OG1 cells searched
  Point region_centre_m{0.0, 0.0};
  // Best a category, in the order of the template set; a detector may leave out those that do not fit.
  std::vector<CategoryDegree> degrees;
  std::optional<Detection> detection;
  // Best of every template, best first and one an orientation; for charts, only when a detector is asked.
  std::vector<TemplateDegree> templates;
  // A category fits when its degree is above this, where a detector has such a threshold; for charts.
  std::optional<double> fits_above{};
};

struct DetectionReport {
  std::vector<Matching> matchings;  // in the order they ran
};

class Detector {
 public:
  virtual ~Detector() = default;
  // Recognises what the changes have made visible; what has not changed is not reported again. Begins
  // no matching once the budget is exhausted. Hot: changes that lead to no matching, on ground that it
  // has seen, allocate nothing.
  virtual DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) = 0;
  // OG2, for pictures and reports; null when the detector keeps none.
  [[nodiscard]] virtual const CoarseGrid* coarse_grid() const { return nullptr; }
};

struct DetectorContext : ModuleContext {
  std::shared_ptr<const TemplateSet> templates{};  // rendered
};

template <>
struct PluginTraits<Detector> {
  static constexpr PluginKind kKind = PluginKind::detector;
  using Context = DetectorContext;
};

}  // namespace cairn
