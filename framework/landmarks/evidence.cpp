#include "framework/landmarks/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

CategoryEvidence& evidence_of(Landmark& landmark, const std::string& category) {
  const auto at = std::ranges::lower_bound(landmark.evidence, category, {}, &CategoryEvidence::category);
  if (at != landmark.evidence.end() && at->category == category) return *at;
  CategoryEvidence fresh;
  fresh.category = category;
  return *landmark.evidence.insert(at, std::move(fresh));
}

// The degrees of a matching that speak of a place; a detector that reports none says it by its detection.
std::vector<CategoryDegree> degrees_at(const Point& place_m, const Matching& matching, double within_m) {
  const auto is_there = [&](const Point& p) { return (p - place_m).norm() <= within_m; };
  std::vector<CategoryDegree> degrees;
  for (const CategoryDegree& degree : matching.degrees)
    if (degree.fits && is_there(degree.at_m)) degrees.push_back(degree);
  if (!matching.detection || !is_there(matching.detection->T_map_landmark.position())) return degrees;
  const auto& [category, T_map_landmark, degree, templates] = *matching.detection;
  if (std::ranges::find(degrees, category, &CategoryDegree::category) == degrees.end())
    degrees.push_back({category, degree, T_map_landmark.theta_rad, T_map_landmark.position()});
  return degrees;
}

void count(Landmark& landmark, const std::vector<CategoryDegree>& degrees) {
  for (CategoryEvidence& evidence : landmark.evidence) evidence.last_degree = 0.0;
  for (const CategoryDegree& degree : degrees) {
    CategoryEvidence& evidence = evidence_of(landmark, degree.category);
    ++evidence.matchings;
    evidence.mean_degree += (degree.degree - evidence.mean_degree) / evidence.matchings;
    evidence.best_degree = std::max(evidence.best_degree, degree.degree);
    evidence.last_degree = degree.degree;
  }
}

}  // namespace

bool add_evidence(Landmark& landmark, const Matching& matching, double within_m) {
  const std::vector<CategoryDegree> degrees = degrees_at(landmark.T_map_landmark.position(), matching, within_m);
  if (degrees.empty()) return false;
  count(landmark, degrees);
  const CategoryDegree& best = *std::ranges::max_element(degrees, {}, &CategoryDegree::degree);
  const bool is_other = best.category != landmark.category;
  if (!is_other && best.degree <= landmark.degree) return false;
  landmark.category = best.category;
  landmark.degree = best.degree;
  landmark.T_map_landmark = {best.at_m.x(), best.at_m.y(), wrap_angle(best.orientation_rad)};
  landmark.templates.clear();
  // A detection knows the place between the cells and the other templates.
  if (matching.detection && matching.detection->category == best.category &&
      (matching.detection->T_map_landmark.position() - best.at_m).norm() <= within_m) {
    landmark.T_map_landmark = matching.detection->T_map_landmark;
    landmark.templates = matching.detection->templates;
  }
  return true;
}

void count_evidence(Landmark& landmark, const Matching& matching, double within_m) {
  const std::vector<CategoryDegree> degrees = degrees_at(landmark.T_map_landmark.position(), matching, within_m);
  if (!degrees.empty()) count(landmark, degrees);
}

void add_evidence(Landmark& landmark, const Landmark& other) {
  landmark.sightings += other.sightings;
  for (const CategoryEvidence& more : other.evidence) {
    CategoryEvidence& evidence = evidence_of(landmark, more.category);
    const int matchings = evidence.matchings + more.matchings;
    if (matchings > 0)
      evidence.mean_degree =
          (evidence.matchings * evidence.mean_degree + more.matchings * more.mean_degree) / matchings;
    evidence.matchings = matchings;
    evidence.best_degree = std::max(evidence.best_degree, more.best_degree);
  }
}

double freed_ratio(const OccupancyGrid& grid, const Contour& contour, const Pose2& T_map_landmark) {
  const Cell centre = grid.cell_at(T_map_landmark.position());
  const int reach = static_cast<int>(std::ceil(0.5 * contour.outer_diameter_m() / grid.cell_m())) + 1;
  const Pose2 T_landmark_map = inverse(T_map_landmark);
  int cells = 0;
  int free = 0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Cell cell = centre + Cell{x, y};
      if (contour.signed_distance(T_landmark_map * grid.centre_of(cell)) > 0.0) continue;
      ++cells;
      free += grid.state(cell) == CellState::free ? 1 : 0;
    }
  }
  return cells == 0 ? 0.0 : static_cast<double>(free) / cells;
}

}  // namespace cairn
