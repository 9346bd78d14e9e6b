#include "maps/submaps/correlative_search.hpp"

#include <algorithm>

namespace cairn {
namespace {

// The window's lattice, and the points of a scan as cells at one of its headings.
class Lattice {
 public:
  Lattice(const LikelihoodField& field, std::span<const SearchLayer> layers, const SearchWindow& window)
      : field_(field), window_(window) {
    double farthest_m = field.cell_m();
    for (const SearchLayer& layer : layers)
      for (const Point& point_m : layer.points_m) farthest_m = std::max(farthest_m, point_m.norm());
    step_rad_ = field.cell_m() / farthest_m;
    half_headings_ = static_cast<int>(std::floor(window.half_angle_rad / step_rad_));
    half_side_ = static_cast<int>(std::floor(window.half_side_m / field.cell_m()));
  }

  [[nodiscard]] int headings() const { return 2 * half_headings_ + 1; }
  [[nodiscard]] int half_side() const { return half_side_; }
  [[nodiscard]] double step_rad() const { return step_rad_; }
  [[nodiscard]] double cell_m() const { return field_.cell_m(); }
  [[nodiscard]] Pose2 pose(int heading, int x, int y) const {
    return {window_.T_field_scan.x_m + x * field_.cell_m(), window_.T_field_scan.y_m + y * field_.cell_m(),
            wrap_angle(window_.T_field_scan.theta_rad + (heading - half_headings_) * step_rad_)};
  }
  [[nodiscard]] std::vector<Eigen::Vector2i> cells(int heading, std::span<const Point> points_m) const {
    const Pose2 T_field_scan = pose(heading, 0, 0);
    std::vector<Eigen::Vector2i> cells;
    cells.reserve(points_m.size());
    for (const Point& point_m : points_m) {
      const Point at_m = T_field_scan * point_m;
      cells.emplace_back(field_.cell_of(at_m.x()), field_.cell_of(at_m.y()));
    }
    return cells;
  }

 private:
  const LikelihoodField& field_;
  SearchWindow window_;
  double step_rad_ = 0.0;
  int half_headings_ = 0;
  int half_side_ = 0;
};

// Greater sums are better; of equal ones the first in the order of heading, y, x.
struct Candidate {
  int sum = 0;
  int heading = 0;
  int x = 0;
  int y = 0;
  [[nodiscard]] bool is_before(const Candidate& other) const {
    if (sum != other.sum) return sum > other.sum;
    if (heading != other.heading) return heading < other.heading;
    return y != other.y ? y < other.y : x < other.x;
  }
};

int least_sum(double min_score, std::size_t points) {
  return std::max(static_cast<int>(std::ceil(min_score * 255.0 * static_cast<double>(points) - 1e-6)), 1);
}

double score_of_sum(int sum, std::size_t points) {
  return sum / (255.0 * static_cast<double>(points));
}

ScanMatch match_of(const Lattice& lattice, const Candidate& best, std::size_t points) {
  return {lattice.pose(best.heading, best.x, best.y), score_of_sum(best.sum, points)};
}

std::size_t count_points(std::span<const SearchLayer> layers) {
  std::size_t points = 0;
  for (const SearchLayer& layer : layers) points += layer.points_m.size();
  return points;
}

// The poses around those found that are no other ones.
class Excluded {
 public:
  Excluded(const Lattice& lattice, double apart_m, double apart_rad)
      : lattice_(lattice), apart_m_(apart_m), apart_rad_(apart_rad) {}

  void add(const Candidate& found) { found_.push_back(found); }
  // Whether all poses of the square are.
  [[nodiscard]] bool holds(const Candidate& square, int side) const {
    return std::ranges::any_of(found_, [&](const Candidate& found) {
      const double turned_rad = wrap_angle((square.heading - found.heading) * lattice_.step_rad());
      if (std::abs(turned_rad) >= apart_rad_) return false;
      const double x = std::max(std::abs(square.x - found.x), std::abs(square.x + side - 1 - found.x));
      const double y = std::max(std::abs(square.y - found.y), std::abs(square.y + side - 1 - found.y));
      return std::hypot(x, y) * lattice_.cell_m() < apart_m_;
    });
  }

 private:
  const Lattice& lattice_;
  double apart_m_;
  double apart_rad_;
  std::vector<Candidate> found_;
};

class BranchAndBound {
 public:
  BranchAndBound(std::span<const SearchLayer> layers, const FieldPyramid* standing, const SearchWindow& window)
      : layers_(layers.begin(), layers.end()),
        standing_(standing),
        lattice_(layers.front().pyramid->field(), layers, window),
        top_level_(layers.front().pyramid->levels() - 1) {
    const Point origin_m{0.0, 0.0};
    origin_ = lattice_.cells(0, {&origin_m, 1}).front();
    for (const SearchLayer& layer : layers) top_level_ = std::min(top_level_, layer.pyramid->levels() - 1);
    if (standing != nullptr) top_level_ = std::min(top_level_, standing->levels() - 1);
    for (int heading = 0; heading < lattice_.headings(); ++heading)
      for (const SearchLayer& layer : layers) cells_.push_back(lattice_.cells(heading, layer.points_m));
    add_roots();
  }

  // The best pose with at least this sum; excluded: null, or what is left out.
  std::optional<Candidate> find(int least_sum, const Excluded* excluded = nullptr) {
    least_sum_ = least_sum;
    excluded_ = excluded;
    best_.reset();
    descend(top_level_, roots_);
    return best_;
  }
  [[nodiscard]] const Lattice& lattice() const { return lattice_; }

 private:
  void add_roots() {
    const int side = 1 << top_level_;
    for (int heading = 0; heading < lattice_.headings(); ++heading)
      for (int y = -lattice_.half_side(); y <= lattice_.half_side(); y += side)
        for (int x = -lattice_.half_side(); x <= lattice_.half_side(); x += side)
          add_bounded(top_level_, heading, x, y, roots_);
    sort(roots_);
  }

  static void sort(std::vector<Candidate>& candidates) {
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) { return a.is_before(b); });
  }

  void add_bounded(int level, int heading, int x, int y, std::vector<Candidate>& candidates) const {
    if (standing_ != nullptr && standing_->greatest(level, origin_.x() + x, origin_.y() + y) == 0) return;
    candidates.push_back({bound(level, heading, x, y), heading, x, y});
  }

  // No pose in the square of 2^level positions has a greater sum.
  [[nodiscard]] int bound(int level, int heading, int x, int y) const {
    int sum = 0;
    for (std::size_t i = 0; i < layers_.size(); ++i)
      for (const Eigen::Vector2i& cell : cells_[static_cast<std::size_t>(heading) * layers_.size() + i])
        sum += layers_[i].pyramid->greatest(level, cell.x() + x, cell.y() + y);
    return sum;
  }

  // candidates: sorted.
  void descend(int level, const std::vector<Candidate>& candidates) {
    for (const Candidate& candidate : candidates) {
      if (candidate.sum < least_sum_ || (best_ && candidate.sum < best_->sum)) return;
      if (excluded_ != nullptr && excluded_->holds(candidate, 1 << level)) continue;
      if (level > 0)
        descend(level - 1, parts_of(level, candidate));
      else if (!best_ || candidate.is_before(*best_))
        best_ = candidate;
    }
  }

  [[nodiscard]] std::vector<Candidate> parts_of(int level, const Candidate& whole) const {
    const int side = 1 << (level - 1);
    std::vector<Candidate> parts;
    for (const int y : {whole.y, whole.y + side})
      for (const int x : {whole.x, whole.x + side})
        if (x <= lattice_.half_side() && y <= lattice_.half_side()) add_bounded(level - 1, whole.heading, x, y, parts);
    sort(parts);
    return parts;
  }

  std::vector<SearchLayer> layers_;
  const FieldPyramid* standing_;
  Lattice lattice_;
  int top_level_;
  Eigen::Vector2i origin_;                           // of the scan, in the window's middle
  std::vector<std::vector<Eigen::Vector2i>> cells_;  // by heading, then by layer
  std::vector<Candidate> roots_;
  int least_sum_ = 1;
  const Excluded* excluded_ = nullptr;
  std::optional<Candidate> best_;
};

}  // namespace

FieldPyramid::FieldPyramid(LikelihoodField field, int levels) : field_(std::move(field)) {
  for (int level = 1; level < levels; ++level) add_level(level);
}

// Each value is the greatest of four of the level below, half a square apart.
void FieldPyramid::add_level(int level) {
  const int half = 1 << (level - 1);
  Maxima maxima;
  maxima.first_x = field_.first_x() - (1 << level) + 1;
  maxima.first_y = field_.first_y() - (1 << level) + 1;
  maxima.width = field_.width() == 0 ? 0 : field_.width() + (1 << level) - 1;
  maxima.height = field_.height() == 0 ? 0 : field_.height() + (1 << level) - 1;
  maxima.values.reserve(static_cast<std::size_t>(maxima.width) * static_cast<std::size_t>(maxima.height));
  for (int y = maxima.first_y; y < maxima.first_y + maxima.height; ++y)
    for (int x = maxima.first_x; x < maxima.first_x + maxima.width; ++x)
      maxima.values.push_back(std::max({greatest(level - 1, x, y), greatest(level - 1, x + half, y),
                                        greatest(level - 1, x, y + half), greatest(level - 1, x + half, y + half)}));
  maxima_.push_back(std::move(maxima));
}

double score_of(const LikelihoodField& field, std::span<const Point> points_m, const Pose2& T_field_scan) {
  if (points_m.empty()) return 0.0;
  int sum = 0;
  for (const Point& point_m : points_m) {
    const Point at_m = T_field_scan * point_m;
    sum += field.value(field.cell_of(at_m.x()), field.cell_of(at_m.y()));
  }
  return score_of_sum(sum, points_m.size());
}

std::optional<ScanMatch> search_all(const LikelihoodField& field, std::span<const Point> points_m,
                                    const SearchWindow& window, double min_score) {
  if (points_m.empty()) return std::nullopt;
  const SearchLayer layer{nullptr, points_m};
  const Lattice lattice(field, {&layer, 1}, window);
  std::optional<Candidate> best;
  for (int heading = 0; heading < lattice.headings(); ++heading) {
    const std::vector<Eigen::Vector2i> cells = lattice.cells(heading, points_m);
    for (int y = -lattice.half_side(); y <= lattice.half_side(); ++y) {
      for (int x = -lattice.half_side(); x <= lattice.half_side(); ++x) {
        Candidate candidate{0, heading, x, y};
        for (const Eigen::Vector2i& cell : cells) candidate.sum += field.value(cell.x() + x, cell.y() + y);
        if (candidate.sum < least_sum(min_score, points_m.size())) continue;
        if (!best || candidate.is_before(*best)) best = candidate;
      }
    }
  }
  return best ? std::optional(match_of(lattice, *best, points_m.size())) : std::nullopt;
}

std::optional<ScanMatch> search(const FieldPyramid& pyramid, std::span<const Point> points_m,
                                const SearchWindow& window, double min_score) {
  if (points_m.empty()) return std::nullopt;
  const SearchLayer layer{&pyramid, points_m};
  BranchAndBound search({&layer, 1}, nullptr, window);
  const std::optional<Candidate> best = search.find(least_sum(min_score, points_m.size()));
  return best ? std::optional(match_of(search.lattice(), *best, points_m.size())) : std::nullopt;
}

std::vector<ScanMatch> search_distinct(std::span<const SearchLayer> layers, const FieldPyramid* standing,
                                       const SearchWindow& window, const DistinctRules& rules) {
  std::vector<ScanMatch> found;
  const std::size_t points = count_points(layers);
  if (points == 0) return found;
  BranchAndBound search(layers, standing, window);
  Excluded excluded(search.lattice(), rules.apart_m, rules.apart_rad);
  double min_score = rules.min_score;
  while (found.size() < rules.at_most) {
    const std::optional<Candidate> best = search.find(least_sum(min_score, points), &excluded);
    if (!best) break;
    found.push_back(match_of(search.lattice(), *best, points));
    min_score = std::max(rules.min_score, rules.min_of_best_ratio * found.front().score);
    excluded.add(*best);
  }
  return found;
}

}  // namespace cairn
