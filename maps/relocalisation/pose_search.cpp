#include "maps/relocalisation/pose_search.hpp"

#include <array>
#include <numbers>

namespace cairn {
namespace {

constexpr int kLevels = 7;
constexpr double kSharp = 0.2;  // of a cell: a field that is full in its own cells and 0 beside them
constexpr int kOnIt = 250;      // in 255ths: of a field that is full in the cells of what is occupied
constexpr double kSurfaceCell_m = 0.3;
constexpr double kMaxMoved_m = 0.3;  // by the alignment
constexpr double kMaxMoved_rad = radians(6.0);

SurfaceMap surfaces_of(const OccupancyGrid& map) {
  std::vector<Point> occupied_m;
  const CellBox box = map.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (map.state({x, y}) == CellState::occupied) occupied_m.push_back(map.centre_of({x, y}));
  SurfaceMap surfaces(kSurfaceCell_m);
  surfaces.add(occupied_m);
  return surfaces;
}

// What is known of the position in its worst direction, over the best: 0 to 1.
double evenness(const Eigen::Matrix3d& information) {
  const double half = 0.5 * (information(0, 0) + information(1, 1));
  const double apart = std::hypot(0.5 * (information(0, 0) - information(1, 1)), information(0, 1));
  return half + apart > 0.0 ? (half - apart) / (half + apart) : 0.0;
}

// Each point of each layer counts alike.
double score_of(std::span<const SearchLayer> layers, const Pose2& T_map_robot) {
  double sum = 0.0;
  double points = 0.0;
  for (const SearchLayer& layer : layers) {
    const auto count = static_cast<double>(layer.points_m.size());
    sum += count * score_of(layer.pyramid->field(), layer.points_m, T_map_robot);
    points += count;
  }
  return points > 0.0 ? sum / points : 0.0;
}

}  // namespace

PoseSearch::PoseSearch(const OccupancyGrid& map, const PoseSearchSettings& settings)
    : settings_(settings),
      occupied_(LikelihoodField(raster_points(map, settings.raster_m).occupied_m, settings.raster_m, settings.sigma_m),
                kLevels),
      free_(
          LikelihoodField(raster_points(map, settings.raster_m).free_m, settings.raster_m, kSharp * settings.raster_m),
          kLevels),
      surfaces_(surfaces_of(map)) {
  const CellBox box = map.bounds();
  if (box.empty()) return;
  const Point low_m = map.centre_of(box.min);
  const Point high_m = map.centre_of(box.max - Cell{1, 1});
  // On the raster, so that positions are the middles of its squares.
  const auto on_raster = [&](double at_m) { return (std::floor(at_m / settings.raster_m) + 0.5) * settings.raster_m; };
  const Point middle_m = 0.5 * (low_m + high_m);
  middle_m_ = {on_raster(middle_m.x()), on_raster(middle_m.y())};
  half_side_m_ = 0.5 * (high_m - low_m).maxCoeff() + 2.0 * settings.raster_m;
}

std::vector<PoseHypothesis> PoseSearch::find(const Surroundings& surroundings,
                                             const std::optional<KnownHeading>& heading) const {
  std::vector<PoseHypothesis> found;
  if (surroundings.echoes_m.empty() || half_side_m_ <= 0.0) return found;
  const std::array<SearchLayer, 2> layers = {{{&occupied_, surroundings.echoes_m}, {&free_, surroundings.free_m}}};
  SearchWindow window{{middle_m_.x(), middle_m_.y(), 0.0}, half_side_m_, std::numbers::pi};
  if (heading && heading->within_rad < std::numbers::pi) {
    window.T_field_scan.theta_rad = heading->heading_rad;
    window.half_angle_rad = heading->within_rad;
  }
  for (const ScanMatch& match : search_distinct(layers, &free_, window, settings_.distinct))
    found.push_back(aligned(match, surroundings));
  return found;
}

// The best score alone would draw the pose away from where it is: beside a map that is not finished, what has been seen
// right is unknown to it, and scores more where it happens to lie on something.
PoseHypothesis PoseSearch::at(const Surroundings& surroundings, const Pose2& T_map_robot) const {
  if (surroundings.echoes_m.empty()) return {T_map_robot};
  const std::array<SearchLayer, 2> layers = {{{&occupied_, surroundings.echoes_m}, {&free_, surroundings.free_m}}};
  const SearchWindow window{T_map_robot, settings_.beside_m, settings_.beside_rad};
  const std::vector<ScanMatch> best = search_distinct(layers, nullptr, window, {.min_score = 0.0, .at_most = 1});
  const PoseHypothesis there = aligned({T_map_robot, score_of(layers, T_map_robot)}, surroundings);
  if (best.empty()) return there;
  const PoseHypothesis beside = aligned(best.front(), surroundings);
  return beside.contradicted_ratio <= there.contradicted_ratio ? beside : there;
}

double PoseSearch::contradicted_ratio(const Surroundings& surroundings, const Pose2& T_map_robot) const {
  const auto value = [&](const FieldPyramid& pyramid, const Point& point_m) {
    const LikelihoodField& field = pyramid.field();
    const Point at_m = T_map_robot * point_m;
    return field.value(field.cell_of(at_m.x()), field.cell_of(at_m.y()));
  };
  std::size_t contradicted = 0;
  for (const Point& echo_m : surroundings.echoes_m)
    contradicted += value(free_, echo_m) > 0 && value(occupied_, echo_m) == 0 ? 1U : 0U;
  for (const Point& free_m : surroundings.free_m) contradicted += value(occupied_, free_m) >= kOnIt ? 1U : 0U;
  return static_cast<double>(contradicted) /
         static_cast<double>(surroundings.echoes_m.size() + surroundings.free_m.size());
}

PoseHypothesis PoseSearch::aligned(const ScanMatch& match, const Surroundings& surroundings) const {
  AlignmentSettings settings;
  settings.echo_sigma_m = 0.05;
  const Alignment alignment = align(surfaces_, surroundings.echoes_m, match.T_field_scan, {}, settings);
  const Pose2 moved = inverse(match.T_field_scan) * alignment.T_map_scan;
  PoseHypothesis hypothesis{match.T_field_scan, match.score};
  hypothesis.contradicted_ratio = contradicted_ratio(surroundings, match.T_field_scan);
  if (moved.position().norm() > kMaxMoved_m || std::abs(moved.theta_rad) > kMaxMoved_rad) return hypothesis;
  hypothesis.T_map_robot = alignment.T_map_scan;
  hypothesis.contradicted_ratio = contradicted_ratio(surroundings, alignment.T_map_scan);
  hypothesis.is_held_by_corners = alignment.matched_ratio >= settings_.min_matched_ratio &&
                                  evenness(alignment.information) >= settings_.min_corner_ratio;
  return hypothesis;
}

}  // namespace cairn
