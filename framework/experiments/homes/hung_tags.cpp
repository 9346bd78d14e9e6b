#include "framework/experiments/homes/hung_tags.hpp"

#include <algorithm>
#include <cmath>

#include "maps/base/portable_random.hpp"

namespace cairn {
namespace {

constexpr int kNumbers = 587;         // of the family 36h11
constexpr double kBeside_m = 0.05;    // of face, beside the paper
constexpr double kPaperRatio = 1.25;  // of size_m: with the white border
constexpr double kApart_m = 0.5;
constexpr double kBefore_m[] = {0.02, 0.15, 0.3, 0.5};
constexpr int kTriesForEach = 100;

bool holds(const HomeObstacle& box, const Point& p_m) {
  return (p_m.array() >= box.min_m.array()).all() && (p_m.array() <= box.max_m.array()).all();
}

class Hanging {
 public:
  Hanging(const HungTagsConfig& config, const std::vector<HomeFace>& faces, const std::vector<HomeObstacle>& obstacles,
          std::uint64_t seed)
      : config_(config), faces_(faces), obstacles_(obstacles), random_(seed, 3) {
    for (const HomeFace& face : faces) all_m_ += (face.b_m - face.a_m).norm();
  }

  [[nodiscard]] std::vector<WorldTag> draw() {
    for (int t = 0; t < kTriesForEach * config_.count && static_cast<int>(tags_.size()) < config_.count; ++t)
      hang_one();
    return std::move(tags_);
  }

 private:
  void hang_one() {
    double along_m = random_.between(0.0, all_m_);
    const int number = random_.whole(0, kNumbers - 1);
    const double height_m = random_.between(0.2, 0.6);
    const auto face = std::ranges::find_if(faces_, [&](const HomeFace& one) {
      const double length_m = (one.b_m - one.a_m).norm();
      if (along_m < length_m) return true;
      along_m -= length_m;
      return false;
    });
    if (face == faces_.end()) return;
    const double length_m = (face->b_m - face->a_m).norm();
    const double margin_m = 0.5 * kPaperRatio * config_.size_m + kBeside_m;
    if (along_m < margin_m || along_m > length_m - margin_m) return;
    const Point along = (face->b_m - face->a_m) / length_m;
    const Point normal(-along.y(), along.x());
    const Point at_m = face->a_m + along_m * along;
    const bool is_covered = std::ranges::any_of(kBefore_m, [&](double before_m) {
      return std::ranges::any_of(obstacles_,
                                 [&](const HomeObstacle& box) { return holds(box, at_m + before_m * normal); });
    });
    const bool is_taken = std::ranges::any_of(tags_, [&](const WorldTag& tag) {
      return tag.marker.number == number || (tag.T_map_tag.position() - at_m).norm() < kApart_m;
    });
    if (is_covered || is_taken) return;
    tags_.push_back({{MarkerFamily::tag36h11, number},
                     {at_m.x(), at_m.y(), std::atan2(normal.y(), normal.x())},
                     height_m,
                     config_.size_m});
  }

  HungTagsConfig config_;
  const std::vector<HomeFace>& faces_;
  const std::vector<HomeObstacle>& obstacles_;
  PortableRandom random_;
  double all_m_ = 0.0;
  std::vector<WorldTag> tags_;
};

}  // namespace

std::vector<WorldTag> hung_tags(const HungTagsConfig& config, const std::vector<HomeFace>& faces,
                                const std::vector<HomeObstacle>& obstacles, std::uint64_t seed) {
  return Hanging(config, faces, obstacles, seed).draw();
}

}  // namespace cairn
