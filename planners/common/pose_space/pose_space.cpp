#include "planners/common/pose_space/pose_space.hpp"

#include <array>
#include <numbers>
#include <utility>

#include "maps/geometry/segments.hpp"
#include "planners/common/disc_space/field_box.hpp"

namespace cairn {
namespace {

constexpr double kLongestBend_m = 0.001;
constexpr double kExactStep_cells = 4.0;

// A pose with its sine and cosine worked out once.
struct Frame {
  Point origin{0.0, 0.0};
  Point x_axis{1.0, 0.0};

  explicit Frame(const Pose2& pose) : origin(pose.position()), x_axis(pose.direction()) {}
  [[nodiscard]] Point operator()(const Point& p) const {
    return origin + p.x() * x_axis + p.y() * Point(-x_axis.y(), x_axis.x());
  }
};

// The convex hull of four points (monotone chain).
struct Hull {
  std::array<Point, 8> corners;
  std::size_t size = 0;

  explicit Hull(std::array<Point, 4> points) {
    std::sort(points.begin(), points.end(),
              [](const Point& a, const Point& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); });
    for (const bool lower : {true, false}) {
      const std::size_t first = size;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& p = points[lower ? i : points.size() - 1 - i];
        while (size >= first + 2 && cross(corners[size - 1] - corners[size - 2], p - corners[size - 2]) <= 0.0) --size;
        corners[size++] = p;
      }
      --size;  // the other chain begins with it
    }
  }
  [[nodiscard]] std::span<const Point> span() const { return {corners.data(), size}; }
};

// No blocked cell is nearer than the field says.
auto free_run_on(const DiscSpace& space) {
  return [&space](Cell cell) {
    const double distance_m = space.field().distance_m(cell);
    if (distance_m > 0.0) return std::max(1, static_cast<int>(distance_m / space.cell_m()));
    return space.is_blocked(cell) ? 0 : 1;
  };
}

// No blocked square is nearer than this.
double at_least_m(const DiscSpace& space, const Point& p) {
  constexpr double kHalfDiagonal = 0.5 * std::numbers::sqrt2;
  const Cell cell = space.field().cell_at(p);
  return space.field().distance_m(cell) - kHalfDiagonal * space.cell_m() - (p - space.field().centre_of(cell)).norm();
}

double to_rim_m(const DiscSpace& space, const Point& p) {
  const DistanceField& field = space.field();
  const auto [low, high] = box_of(field, field.box());
  return std::min((p - low).minCoeff(), (high - p).minCoeff());
}

}  // namespace

// Places on it are given as shares of the element, from 0 to 1.
struct PoseSpace::ElementSweep {
  Pose2 from;
  MotionElement element;
  double far_m = 0.0;        // furthest point of the outline, or the origin, from the centre of turning
  double displaced_m = 0.0;  // no point of the outline moves more
  double exact_step = 1.0;
  // The sides through which points can enter the outline: only these need to be swept. As the robot turns
  // about a point of its own frame, a side leads along the whole element or never.
  std::vector<std::pair<Point, Point>> leading;

  ElementSweep(const PoseSpace& space, const Pose2& start, const MotionElement& driven_element)
      : from(start), element(driven_element) {
    const bool turns = element.turn_rad != 0.0;
    const Point hub(0.0, turns ? element.signed_radius_m() : 0.0);
    const std::vector<Point>& corners = space.footprint_.corners_m();
    far_m = hub.norm();
    for (const Point& corner : corners) far_m = std::max(far_m, (corner - hub).norm());
    displaced_m = turns ? far_m * std::abs(element.turn_rad) : std::abs(element.length_m);
    exact_step = kExactStep_cells * space.space_->cell_m() / displaced_m;
    if (turns)
      exact_step = std::min(exact_step, std::sqrt(8.0 * space.bend_slack_m_ / far_m) / std::abs(element.turn_rad));
    const auto velocity = [&](const Point& p) {  // up to a positive factor
      const Point arm = std::copysign(1.0, element.turn_rad) * (p - hub);
      return turns ? Point(-arm.y(), arm.x()) : Point(std::copysign(1.0, element.length_m), 0.0);
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point& a = corners[i];
      const Point& b = corners[(i + 1) % corners.size()];
      const Point outwards(b.y() - a.y(), a.x() - b.x());
      const double most = std::max(outwards.dot(velocity(a)), outwards.dot(velocity(b)));
      if (most > -1e-9 * outwards.norm() * (turns ? far_m : 1.0)) leading.emplace_back(a, b);
    }
  }

  [[nodiscard]] Pose2 pose_at(double share) const { return driven(from, element.share(share)); }
};

PoseSpace::PoseSpace(const DiscSpace& space, Footprint footprint, double margin_m)
    : space_(&space),
      footprint_(std::move(footprint)),
      margin_m_(std::max(margin_m, kMinRadius_m)),
      bend_slack_m_(std::min(kLongestBend_m, 0.02 * space.cell_m())) {}

// How far every point of the outline may move before it can touch anything; 0 or less: not known.
double PoseSpace::clear_m(const Pose2& pose) const {
  const Frame T_map_robot(pose);
  double min_m = to_rim_m(*space_, pose.position());
  for (const Footprint::Disc& disc : footprint_.cover())
    min_m = std::min(min_m, at_least_m(*space_, T_map_robot(disc.centre)) - disc.radius_m - margin_m_);
  return min_m;
}

bool PoseSpace::touches(const Pose2& pose) const {
  const Frame T_map_robot(pose);
  std::vector<Point> corners;
  corners.reserve(footprint_.corners_m().size());
  for (const Point& corner : footprint_.corners_m()) corners.push_back(T_map_robot(corner));
  return polygon_touches({space_->field().origin_m(), space_->cell_m()}, corners, margin_m_, free_run_on(*space_));
}

bool PoseSpace::fits(const Pose2& pose) const {
  const Point at = pose.position();
  if (!is_finite(pose) || !space_->contains(at)) return false;
  if (footprint_.is_disc()) return space_->fits(at, footprint_.inscribed_m() + margin_m_);
  const Cell cell = space_->field().cell_at(at);
  if (space_->field().distance_m(cell) + (at - space_->field().centre_of(cell)).norm() < footprint_.inscribed_m())
    return false;
  return clear_m(pose) > 0.0 || !touches(pose);
}

// From a pose that fits.
bool PoseSpace::segment_fits(const ElementSweep& sweep, double from, double to) const {
  const Pose2 first = sweep.pose_at(from);
  const Pose2 last = sweep.pose_at(to);
  if (!space_->contains(last.position())) return false;
  // The arc of a point strays from its chord by this at most, and the chords of a side lie in the hull of
  // its first and last position.
  const double stray_m = sweep.far_m * (1.0 - std::cos(0.5 * (to - from) * sweep.element.turn_rad));
  if (footprint_.is_disc())
    return space_->fits_along(first.position(), last.position(), footprint_.inscribed_m() + margin_m_ + stray_m);
  const Frame T_map_first(first);
  const Frame T_map_last(last);
  for (const auto& [a, b] : sweep.leading) {
    const Hull swept({T_map_first(a), T_map_first(b), T_map_last(a), T_map_last(b)});
    if (polygon_touches({space_->field().origin_m(), space_->cell_m()}, swept.span(), margin_m_ + stray_m,
                        free_run_on(*space_)))
      return false;
  }
  return true;
}

// From a pose that fits: how far by steps that are known to.
double PoseSpace::share_reached(const ElementSweep& sweep) const {
  if (sweep.displaced_m == 0.0) return 1.0;
  for (double at = 0.0; at < 1.0;) {
    double step = clear_m(sweep.pose_at(at)) / sweep.displaced_m;
    if (step < sweep.exact_step) {
      step = sweep.exact_step;
      if (!segment_fits(sweep, at, std::min(at + step, 1.0))) return at;
    }
    at += step;
  }
  return 1.0;
}

bool PoseSpace::fits_along(const Motion& motion) const {
  if (!motion.is_finite() || !fits(motion.start())) return false;
  for (std::size_t i = 0; i < motion.elements().size(); ++i)
    if (share_reached(ElementSweep(*this, motion.start_of(i), motion.elements()[i])) < 1.0) return false;
  return true;
}

double PoseSpace::share_refined(const ElementSweep& sweep, double good) const {
  double bad = std::min(good + sweep.exact_step, 1.0);
  const double start = good;
  while ((bad - good) * sweep.displaced_m > 0.01 * space_->cell_m()) {
    const double middle = 0.5 * (good + bad);
    (segment_fits(sweep, start, middle) ? good : bad) = middle;
  }
  return good;
}

double PoseSpace::share_that_fits(const Motion& motion) const {
  if (!motion.is_finite() || !fits(motion.start())) return 0.0;
  double reached_m = 0.0;
  for (std::size_t i = 0; i < motion.elements().size(); ++i) {
    const ElementSweep sweep(*this, motion.start_of(i), motion.elements()[i]);
    const double share = share_reached(sweep);
    const double extent_m = motion.extent_of(motion.elements()[i]);
    if (share < 1.0) return (reached_m + share_refined(sweep, share) * extent_m) / motion.extent_m();
    reached_m += extent_m;
  }
  return 1.0;
}

}  // namespace cairn
