#include "framework/templates/template_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/contracts/detector.hpp"
#include "maps/base/in_parallel.hpp"

namespace cairn {
namespace {

// Not those of the templates' own orbits.
constexpr std::uint64_t kSeed = 4711;
constexpr double kStandoff_m = 0.6;
constexpr double kClose = 0.05;  // in degree: no class is decided between two so near
const Point kOffsetInCell{0.3, -0.2};

// Angle between two orientations of a shape that repeats after a period.
double orientation_error(double a_rad, double b_rad, double period_rad) {
  return std::abs(std::remainder(a_rad - b_rad, period_rad));
}

DetectionReport report_on(const OccupancyGrid& grid, const std::shared_ptr<const TemplateSet>& set,
                          const PluginChoice& choice, const OrbitCrew& crew) {
  DetectorContext context{{crew.robot}};
  context.templates = set;
  context.modules = &crew.modules;
  return crew.modules.make<Detector>(choice, context)->detect(grid, everything_in(grid.bounds()), Budget());
}

// Of the best detection, or the best degrees when there is none.
void take_answer(const DetectionReport& report, TemplateView& view, double period_rad) {
  view.found.clear();
  view.rival.clear();
  view.degree = view.right_degree = view.rival_degree = 0.0;
  const Detection* best = nullptr;
  for (const Matching& matching : report.matchings) {
    for (const CategoryDegree& degree : matching.degrees) {
      if (degree.category == view.shown) view.right_degree = std::max(view.right_degree, degree.degree);
      if (degree.category != view.shown && degree.degree > view.rival_degree) {
        view.rival = degree.category;
        view.rival_degree = degree.degree;
      }
      if (best == nullptr) view.degree = std::max(view.degree, degree.degree);
    }
    if (!matching.detection || (best != nullptr && matching.detection->degree <= best->degree)) continue;
    best = &*matching.detection;
    view.degree = best->degree;
    view.found = best->category;
    if (period_rad > 0.0)
      view.orientation_error_rad = orientation_error(best->T_map_landmark.theta_rad, view.orientation_rad, period_rad);
  }
}

TemplateView view_of(const std::shared_ptr<const TemplateSet>& set, const CheckedDetector& detector,
                     const OrbitCrew& crew, const LandmarkShape& shape, const OrbitPlan& plan,
                     std::size_t orientations) {
  const auto mapper = map_of_orbits(crew, shape.contour, plan);
  const double period_rad = orientations > 1 ? static_cast<double>(orientations) * set->step_rad : 0.0;
  TemplateView view;
  view.shown = shape.category;
  view.orientation_rad = plan.orientation_rad;
  take_answer(report_on(mapper->grid(), set, detector.quick, crew), view, period_rad);
  if (!view.is_right()) take_answer(report_on(mapper->grid(), set, detector.thorough, crew), view, period_rad);
  return view;
}

struct OrbitTask {
  const LandmarkShape* shape;
  std::size_t orientations;
  OrbitPlan plan;
};

std::vector<OrbitTask> orbit_tasks_for(const TemplateSet& set) {
  std::vector<OrbitTask> tasks;
  for (const LandmarkShape& shape : set.shapes) {
    const std::vector<double> orientations = distinct_orientations(shape.contour, set.step_rad, set.cell_m);
    Side side = Side::left;
    for (const double orientation_rad : orientations) {
      for (const double between : {0.0, 0.5}) {
        OrbitTask task{&shape, orientations.size(), {}};
        task.plan.orientation_rad = orientation_rad + between * set.step_rad;
        task.plan.offset_m = set.cell_m * kOffsetInCell;
        task.plan.landmark_sides = {side};
        task.plan.standoffs_m = {kStandoff_m};
        task.plan.seed = kSeed + tasks.size();
        tasks.push_back(task);
        side = side == Side::left ? Side::right : Side::left;
      }
    }
  }
  return tasks;
}

// The greatest distance of a point of the one outline, turned, from the other.
double distance_from(const Contour& outline, const Contour& other, double turn_rad) {
  constexpr int kPointsPerSide = 8;
  const Pose2 turn{0.0, 0.0, turn_rad};
  double greatest_m = 0.0;
  for (const std::vector<Point>& corners : outline.outlines_m(72)) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point side = corners[(i + 1) % corners.size()] - corners[i];
      for (int k = 0; k < kPointsPerSide; ++k) {
        const Point p = turn * Point(corners[i] + (static_cast<double>(k) / kPointsPerSide) * side);
        greatest_m = std::max(greatest_m, std::abs(other.signed_distance(p)));
      }
    }
  }
  return greatest_m;
}

const Contour& contour_of(const TemplateSet& set, const std::string& category) {
  return std::ranges::find(set.shapes, category, &LandmarkShape::category)->contour;
}

std::string advice_for_pair(const TemplateSet& set, const std::string& shown, const std::string& found,
                            const std::string& how, int times) {
  const double difference_m = outline_difference_m(contour_of(set, shown), contour_of(set, found));
  const double cells = difference_m / set.cell_m;
  std::string advice = fmt::format("{} {} {} {} time{}: their outlines differ by at most {:.2f} m, {:.1f} cells; ",
                                   shown, how, found, times, times == 1 ? "" : "s", difference_m, cells);
  if (cells < 1.0) return advice + "leave one of them out, or make them differ more in size or form";
  if (cells < 3.0)
    return advice + fmt::format("smaller cells (--cell-m {:.3f}) may distinguish them, or a greater difference in size",
                                difference_m / 3.0);
  return advice + "a greater detector.min_margin leaves such views unknown instead";
}

std::vector<std::string> advice_for(const TemplateSet& set, const TemplateCheck& check) {
  std::vector<std::string> advice;
  for (const std::string& shown : check.categories) {
    for (const auto& [found, times] : check.found_for(shown)) {
      if (found == shown) continue;
      if (!found.empty()) advice.push_back(advice_for_pair(set, shown, found, "taken for", times));
    }
    double least = 1.0;
    int missed = 0;
    std::map<std::string, int> too_close;  // categories that come so near that nothing is decided
    for (const TemplateView& view : check.views) {
      if (view.shown != shown || !view.found.empty()) continue;
      if (view.rival_degree > view.right_degree - kClose) {
        ++too_close[view.rival];
        continue;
      }
      least = std::min(least, view.right_degree);
      ++missed;
    }
    for (const auto& [rival, times] : too_close)
      advice.push_back(advice_for_pair(set, shown, rival, "left open beside", times));
    if (missed > 0)
      advice.push_back(
          fmt::format("{} not recognised {} time{}: its degree falls to {:.2f}; a finer step (--step-deg), a lower "
                      "detector.tau_match or detector.min_margin, or a larger shape would help",
                      shown, missed, missed == 1 ? "" : "s", least));
  }
  return advice;
}

}  // namespace

std::map<std::string, int> TemplateCheck::found_for(const std::string& category) const {
  std::map<std::string, int> found;
  for (const TemplateView& view : views) {
    if (view.shown == category) ++found[view.found];
  }
  return found;
}

bool TemplateCheck::has_mistakes() const {
  return std::ranges::any_of(views, [](const TemplateView& v) { return !v.found.empty() && !v.is_right(); });
}

double outline_difference_m(const Contour& a, const Contour& b) {
  double min_m = std::numeric_limits<double>::infinity();
  for (int turn_deg = 0; turn_deg < 360; ++turn_deg) {
    const double turn_rad = radians(turn_deg);
    const double there_m = distance_from(a, b, turn_rad);
    if (there_m < min_m) min_m = std::min(min_m, std::max(there_m, distance_from(b, a, -turn_rad)));
  }
  return min_m;
}

TemplateCheck check_templates(const std::shared_ptr<const TemplateSet>& set, const CheckedDetector& detector,
                              const OrbitCrew& crew) {
  TemplateCheck check;
  for (const LandmarkShape& shape : set->shapes) check.categories.push_back(shape.category);
  const std::vector<OrbitTask> tasks = orbit_tasks_for(*set);
  check.views.resize(tasks.size());
  in_parallel(tasks.size(), [&](std::size_t i) {
    check.views[i] = view_of(set, detector, crew, *tasks[i].shape, tasks[i].plan, tasks[i].orientations);
  });
  check.advice = advice_for(*set, check);
  return check;
}

}  // namespace cairn
