#include "maps/submaps/correlative_search.hpp"

#include <algorithm>

namespace cairn {
namespace {

// The window's lattice, and the scan's points as cells at one of its headings.
class Lattice {
 public:
  Lattice(const LikelihoodField& field, std::span<const Point> points_m, const SearchWindow& window)
      : field_(field), points_m_(points_m), window_(window) {
    double farthest_m = field.cell_m();
    for (const Point& point_m : points_m) farthest_m = std::max(farthest_m, point_m.norm());
    step_rad_ = field.cell_m() / farthest_m;
    half_headings_ = static_cast<int>(std::floor(window.half_angle_rad / step_rad_));
    half_side_ = static_cast<int>(std::floor(window.half_side_m / field.cell_m()));
  }

  [[nodiscard]] int headings() const { return 2 * half_headings_ + 1; }
  [[nodiscard]] int half_side() const { return half_side_; }
  [[nodiscard]] Pose2 pose(int heading, int x, int y) const {
    return {window_.T_field_scan.x_m + x * field_.cell_m(), window_.T_field_scan.y_m + y * field_.cell_m(),
            wrap_angle(window_.T_field_scan.theta_rad + (heading - half_headings_) * step_rad_)};
  }
  [[nodiscard]] std::vector<Eigen::Vector2i> cells(int heading) const {
    const Pose2 T_field_scan = pose(heading, 0, 0);
    std::vector<Eigen::Vector2i> cells;
    cells.reserve(points_m_.size());
    for (const Point& point_m : points_m_) {
      const Point at_m = T_field_scan * point_m;
      cells.emplace_back(field_.cell_of(at_m.x()), field_.cell_of(at_m.y()));
    }
    return cells;
  }

 private:
  const LikelihoodField& field_;
  std::span<const Point> points_m_;
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

std::optional<ScanMatch> match_of(const Lattice& lattice, const std::optional<Candidate>& best, std::size_t points) {
  if (!best) return std::nullopt;
  return ScanMatch{lattice.pose(best->heading, best->x, best->y), score_of_sum(best->sum, points)};
}

class BranchAndBound {
 public:
  BranchAndBound(const FieldPyramid& pyramid, std::span<const Point> points_m, const SearchWindow& window,
                 double min_score)
      : pyramid_(pyramid),
        lattice_(pyramid.field(), points_m, window),
        least_sum_(least_sum(min_score, points_m.size())) {
    for (int heading = 0; heading < lattice_.headings(); ++heading) cells_.push_back(lattice_.cells(heading));
  }

  std::optional<Candidate> run() {
    const int level = pyramid_.levels() - 1;
    const int side = 1 << level;
    std::vector<Candidate> roots;
    for (int heading = 0; heading < lattice_.headings(); ++heading)
      for (int y = -lattice_.half_side(); y <= lattice_.half_side(); y += side)
        for (int x = -lattice_.half_side(); x <= lattice_.half_side(); x += side)
          roots.push_back({bound(level, heading, x, y), heading, x, y});
    descend(level, roots);
    return best_;
  }
  [[nodiscard]] const Lattice& lattice() const { return lattice_; }

 private:
  // No pose in the square of 2^level positions has a greater sum.
  [[nodiscard]] int bound(int level, int heading, int x, int y) const {
    int sum = 0;
    for (const Eigen::Vector2i& cell : cells_[static_cast<std::size_t>(heading)])
      sum += pyramid_.greatest(level, cell.x() + x, cell.y() + y);
    return sum;
  }

  void descend(int level, std::vector<Candidate>& candidates) {
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return a.is_before(b); });
    for (const Candidate& candidate : candidates) {
      if (candidate.sum < least_sum_ || (best_ && candidate.sum < best_->sum)) return;
      if (level == 0) {
        if (!best_ || candidate.is_before(*best_)) best_ = candidate;
      } else {
        std::vector<Candidate> parts = parts_of(level, candidate);
        descend(level - 1, parts);
      }
    }
  }

  [[nodiscard]] std::vector<Candidate> parts_of(int level, const Candidate& whole) const {
    const int side = 1 << (level - 1);
    std::vector<Candidate> parts;
    for (const int y : {whole.y, whole.y + side})
      for (const int x : {whole.x, whole.x + side})
        if (x <= lattice_.half_side() && y <= lattice_.half_side())
          parts.push_back({bound(level - 1, whole.heading, x, y), whole.heading, x, y});
    return parts;
  }

  const FieldPyramid& pyramid_;
  Lattice lattice_;
  int least_sum_;
  std::vector<std::vector<Eigen::Vector2i>> cells_;  // by heading
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
  const Lattice lattice(field, points_m, window);
  std::optional<Candidate> best;
  for (int heading = 0; heading < lattice.headings(); ++heading) {
    const std::vector<Eigen::Vector2i> cells = lattice.cells(heading);
    for (int y = -lattice.half_side(); y <= lattice.half_side(); ++y) {
      for (int x = -lattice.half_side(); x <= lattice.half_side(); ++x) {
        Candidate candidate{0, heading, x, y};
        for (const Eigen::Vector2i& cell : cells) candidate.sum += field.value(cell.x() + x, cell.y() + y);
        if (candidate.sum < least_sum(min_score, points_m.size())) continue;
        if (!best || candidate.is_before(*best)) best = candidate;
      }
    }
  }
  return match_of(lattice, best, points_m.size());
}

std::optional<ScanMatch> search(const FieldPyramid& pyramid, std::span<const Point> points_m,
                                const SearchWindow& window, double min_score) {
  if (points_m.empty()) return std::nullopt;
  BranchAndBound search(pyramid, points_m, window, min_score);
  const std::optional<Candidate> best = search.run();
  return match_of(search.lattice(), best, points_m.size());
}

}  // namespace cairn
