#include "maps/edit/alignment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "maps/grid/distance_field.hpp"
#include "maps/landmarks/landmark_pairs.hpp"
#include "maps/relocalisation/pose_search.hpp"
#include "maps/relocalisation/surroundings.hpp"

namespace cairn {
namespace {

constexpr double kRaster_m = 0.1;
constexpr double kBesideWall_m = 0.15;
constexpr double kInTheOpen_m = 0.35;
constexpr std::size_t kMaxPairGuesses = 2000;
constexpr std::size_t kMaxPoints = 4000;      // of each kind
constexpr double kLandmarkIsWorth_m2 = 0.25;  // of wall
constexpr double kContradictionCosts = 2.0;

Pose2 between(const Point& a1, const Point& a2, const Point& b1, const Point& b2) {
  const Point a = a2 - a1;
  const Point b = b2 - b1;
  const double theta_rad = wrap_angle(std::atan2(a.y(), a.x()) - std::atan2(b.y(), b.x()));
  const Pose2 turn{0.0, 0.0, theta_rad};
  const Point middle = 0.5 * (a1 + a2) - turn * Point(0.5 * (b1 + b2));
  return {middle.x(), middle.y(), theta_rad};
}

std::vector<Point> thinned_points(const std::vector<Point>& all, std::size_t at_most) {
  const std::size_t count = std::min(all.size(), at_most);
  std::vector<Point> kept;
  for (std::size_t i = 0; i < count; ++i) kept.push_back(all[i * all.size() / count]);
  return kept;
}

OccupancyGrid part_of(const OccupancyGrid& grid, const Point& middle_m, double half_m) {
  OccupancyGrid part(grid.cell_m(), 4.0, grid.origin_m());
  const Cell low = grid.cell_at(middle_m - Point(half_m, half_m));
  const Cell high = grid.cell_at(middle_m + Point(half_m, half_m));
  const CellBox box = grid.bounds();
  for (int y = std::max(low.y, box.min.y); y < std::min(high.y, box.max.y); ++y)
    for (int x = std::max(low.x, box.min.x); x < std::min(high.x, box.max.x); ++x)
      if (const LogOdds known = grid.log_odds({x, y}); known != 0) part.set_log_odds({x, y}, known);
  return part;
}

struct Guess {
  MapAlignment at;
  double score = 0.0;
};

// Landmarks of a graph that stand where the other map knows something.
std::size_t known_places(const LandmarkGraph& graph, const Pose2& T_grid_graph, const OccupancyGrid& grid) {
  return static_cast<std::size_t>(std::ranges::count_if(graph.landmarks(), [&](const auto& entry) {
    const Point at_m = T_grid_graph * entry.second.T_map_landmark.position();
    return grid.state(grid.cell_at(at_m)) != CellState::unknown;
  }));
}

class Aligner {
 public:
  Aligner(const SavedMap& a, const SavedMap& b, const AlignmentRules& rules)
      : a_(a), b_(b), rules_(rules), walls_(a.grid, UnknownPolicy::allow) {
    const RasterPoints points = raster_points(b.grid, kRaster_m);
    places_ = points.free_m;
    wall_points_ = thinned_points(points.occupied_m, kMaxPoints);
    free_points_ = thinned_points(points.free_m, kMaxPoints);
    if (!wall_points_.empty())
      wall_point_m2_ = kRaster_m * kRaster_m * static_cast<double>(points.occupied_m.size()) /
                       static_cast<double>(wall_points_.size());
    if (!free_points_.empty())
      free_point_m2_ =
          kRaster_m * kRaster_m * static_cast<double>(points.free_m.size()) / static_cast<double>(free_points_.size());
  }

  AlignmentResult align() {
    guess_by_landmarks();
    refine_best();
    if (guesses_.empty() || guesses_.front().at.landmarks < rules_.enough_landmarks) {
      guess_by_parts();
      refine_best();
    }
    return decide();
  }

 private:
  static constexpr std::size_t kMaxRefined = 20;
  static constexpr std::size_t kCoarse = 8;

  void refine_best() {
    std::ranges::stable_sort(guesses_, std::greater(), &Guess::score);
    keep_distinct();
    for (Guess& guess : guesses_) guess = refined(judged(guess.at.T_a_b, 1));
    std::ranges::stable_sort(guesses_, std::greater(), &Guess::score);
  }

  // The best of those that are one, and the best of these.
  void keep_distinct() {
    std::vector<Guess> kept;
    for (const Guess& guess : guesses_) {
      const auto is_same = [&](const Guess& other) {
        return !is_farther(guess.at.T_a_b, other.at.T_a_b, 0.3 * rules_.apart_m, 0.3 * rules_.apart_rad);
      };
      if (kept.size() < kMaxRefined && std::ranges::none_of(kept, is_same)) kept.push_back(guess);
    }
    guesses_ = std::move(kept);
  }

  void add_guess(const Pose2& T_a_b) {
    const Guess guess = judged(T_a_b, kCoarse);
    if (guess.score > 0.0) guesses_.push_back(guess);
  }

  // Two landmarks are as far apart wherever they are seen from.
  void guess_by_landmarks() {
    std::size_t tried = 0;
    for (const auto& [a1, first_a] : a_.graph.landmarks())
      for (const auto& [a2, second_a] : a_.graph.landmarks())
        for (const auto& [b1, first_b] : b_.graph.landmarks())
          for (const auto& [b2, second_b] : b_.graph.landmarks()) {
            if (a1 == a2 || b1 >= b2 || first_a.category != first_b.category || second_a.category != second_b.category)
              continue;
            const Point pa1 = first_a.T_map_landmark.position();
            const Point pa2 = second_a.T_map_landmark.position();
            const Point pb1 = first_b.T_map_landmark.position();
            const Point pb2 = second_b.T_map_landmark.position();
            const double apart_m = (pb2 - pb1).norm();
            if (apart_m < 1.0 || std::abs((pa2 - pa1).norm() - apart_m) > rules_.near_m) continue;
            if (++tried > kMaxPairGuesses) return;
            add_guess(between(pa1, pa2, pb1, pb2));
          }
  }

  void guess_by_parts() {
    const PoseSearch search(a_.grid, {.distinct = {.min_score = 0.5, .min_of_best_ratio = 0.8, .at_most = 4}});
    for (const Point& at_m : middles()) {
      const Pose2 T_b_part{at_m.x(), at_m.y(), 0.0};
      const OccupancyGrid part = part_of(b_.grid, at_m, rules_.window_m);
      for (const PoseHypothesis& found : search.find(surroundings_of(part, T_b_part)))
        add_guess(found.T_map_robot * inverse(T_b_part));
    }
  }

  // Free places of b, far enough from each other.
  [[nodiscard]] std::vector<Point> middles() const {
    std::vector<Point> all;
    for (const Point& place : places_) {
      const auto is_near = [&](const Point& other) { return (other - place).norm() < rules_.window_every_m; };
      if (std::ranges::none_of(all, is_near)) all.push_back(place);
    }
    return thinned_points(all, static_cast<std::size_t>(rules_.max_windows));
  }

  // By one point in so many.
  [[nodiscard]] Guess judged(const Pose2& T_a_b, std::size_t every) const {
    std::size_t walls = 0;
    std::size_t on_walls = 0;
    std::size_t free = 0;
    std::size_t against = 0;
    double beside_m = 0.0;  // of those that lie on walls or beside them
    for (std::size_t i = 0; i < wall_points_.size(); i += every) {
      const Cell cell = a_.grid.cell_at(T_a_b * wall_points_[i]);
      if (a_.grid.state(cell) == CellState::unknown) continue;
      ++walls;
      const double away_m = walls_.distance_m(cell);
      on_walls += away_m <= kBesideWall_m ? 1 : 0;
      beside_m += away_m <= kBesideWall_m ? away_m : 0.0;
      against += away_m >= kInTheOpen_m ? 1 : 0;
    }
    for (std::size_t i = 0; i < free_points_.size(); i += every) {
      const CellState state = a_.grid.state(a_.grid.cell_at(T_a_b * free_points_[i]));
      free += state != CellState::unknown ? 1 : 0;
      against += state == CellState::occupied ? 1 : 0;
    }
    Guess guess;
    guess.at.T_a_b = T_a_b;
    guess.at.landmarks = near_pairs(a_.graph, b_.graph, T_a_b, rules_.near_m).size();
    const std::size_t seen_by_both =
        known_places(b_.graph, T_a_b, a_.grid) + known_places(a_.graph, inverse(T_a_b), b_.grid);
    guess.at.missing_landmarks = seen_by_both - std::min(2 * guess.at.landmarks, seen_by_both);
    if (walls + free == 0) return guess;
    const double each_m2 = wall_point_m2_ * static_cast<double>(every);
    const double wall_m2 = each_m2 * static_cast<double>(walls);
    guess.at.shared_m2 = wall_m2 + free_point_m2_ * static_cast<double>(every) * static_cast<double>(free);
    guess.at.shared_wall_m2 = wall_m2;
    guess.at.wall_ratio = walls == 0 ? 0.0 : static_cast<double>(on_walls) / static_cast<double>(walls);
    guess.at.contradicted_ratio = static_cast<double>(against) / static_cast<double>(walls + free);
    const double shared =
        each_m2 * (2.0 * static_cast<double>(on_walls) - beside_m / kBesideWall_m - static_cast<double>(walls));
    guess.score = shared +
                  kLandmarkIsWorth_m2 *
                      (static_cast<double>(guess.at.landmarks) - static_cast<double>(guess.at.missing_landmarks)) -
                  kContradictionCosts * guess.at.contradicted_ratio * guess.at.shared_m2;
    return guess;
  }

  // Steps downhill, from a raster's square to a tenth of it.
  [[nodiscard]] Guess refined(Guess best) const {
    for (double step_m = kRaster_m; step_m > 0.1 * kRaster_m; step_m *= 0.5) {
      const double step_rad = step_m / rules_.window_m;
      for (bool is_better = true; is_better;) {
        is_better = false;
        for (int turn = -1; turn <= 1; ++turn)
          for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
              const Pose2& T = best.at.T_a_b;
              const Guess guess =
                  judged({T.x_m + x * step_m, T.y_m + y * step_m, wrap_angle(T.theta_rad + turn * step_rad)}, 1);
              if (guess.score <= best.score + 1e-9) continue;
              best = guess;
              is_better = true;
            }
      }
    }
    return best;
  }

  [[nodiscard]] static bool is_farther(const Pose2& one, const Pose2& other, double apart_m, double apart_rad) {
    return (one.position() - other.position()).norm() > apart_m ||
           std::abs(wrap_angle(one.theta_rad - other.theta_rad)) > apart_rad;
  }

  [[nodiscard]] AlignmentResult decide() const {
    if (guesses_.empty()) return {std::nullopt, "nothing of the second map is like anything in the first"};
    const MapAlignment& best = guesses_.front().at;
    if (best.shared_wall_m2 < rules_.min_shared_wall_m2)
      return {std::nullopt, fmt::format("where they fit best they share {:.1f} m2 of walls, too little to be sure",
                                        best.shared_wall_m2)};
    if (best.wall_ratio < rules_.min_wall_ratio || best.contradicted_ratio > rules_.max_contradicted_ratio)
      return {
          std::nullopt,
          fmt::format("where they fit best, {:.0f} % of the second map's walls lie on walls of the first, and {:.0f} "
                      "% of what both know contradicts",
                      100.0 * best.wall_ratio, 100.0 * best.contradicted_ratio)};
    for (const Guess& other : guesses_)
      if (other.score > rules_.clear_ratio * guesses_.front().score &&
          is_farther(best.T_a_b, other.at.T_a_b, rules_.apart_m, rules_.apart_rad))
        return {
            std::nullopt,
            fmt::format("they fit at ({:.2f}, {:.2f}, {:.0f} deg) and nearly as well at ({:.2f}, {:.2f}, {:.0f} deg)",
                        best.T_a_b.x_m, best.T_a_b.y_m, degrees(best.T_a_b.theta_rad), other.at.T_a_b.x_m,
                        other.at.T_a_b.y_m, degrees(other.at.T_a_b.theta_rad))};
    return {best, ""};
  }

  const SavedMap& a_;
  const SavedMap& b_;
  const AlignmentRules& rules_;
  DistanceField walls_;
  std::vector<Point> places_;  // free ones of b
  std::vector<Point> wall_points_;
  std::vector<Point> free_points_;
  double wall_point_m2_ = 0.0;  // of b, for which one point stands
  double free_point_m2_ = 0.0;
  std::vector<Guess> guesses_;
};

}  // namespace

AlignmentResult align_maps(const SavedMap& a, const SavedMap& b, const AlignmentRules& rules) {
  if (a.grid.bounds().empty() || b.grid.bounds().empty()) return {std::nullopt, "one of them has no cells"};
  if (a.grid.cell_m() != b.grid.cell_m())
    throw std::invalid_argument(fmt::format("cells of {:g} m and of {:g} m", a.grid.cell_m(), b.grid.cell_m()));
  return Aligner(a, b, rules).align();
}

}  // namespace cairn
