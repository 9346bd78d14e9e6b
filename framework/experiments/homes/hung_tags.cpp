#include "framework/experiments/homes/hung_tags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "framework/contracts/world.hpp"
#include "maps/base/portable_random.hpp"

namespace cairn {
namespace {

constexpr int kNumbers = 587;         // of the family 36h11
constexpr double kBeside_m = 0.05;    // of face, beside the paper
constexpr double kPaperRatio = 1.25;  // of size_m: with the white border
constexpr double kApart_m = 0.5;
constexpr double kBefore_m[] = {0.02, 0.15, 0.3, 0.5};
constexpr int kTriesForEach = 100;

// Of its four sides, those that stand against no wall.
std::vector<HomeFace> free_sides(const HomeRoom& box, const std::vector<HomeRoom>& rooms) {
  const auto& [min_m, max_m] = box;
  const Point right_m(max_m.x(), min_m.y());
  const Point left_m(min_m.x(), max_m.y());
  std::vector<HomeFace> sides{{right_m, min_m}, {max_m, right_m}, {left_m, max_m}, {min_m, left_m}};
  std::erase_if(sides, [&](const HomeFace& side) {
    const Point along = (side.b_m - side.a_m).normalized();
    const Point before_m = 0.5 * (side.a_m + side.b_m) + 0.3 * Point(-along.y(), along.x());
    return std::ranges::none_of(rooms, [&](const HomeRoom& room) { return room.contains(before_m); });
  });
  return sides;
}

class Hanging {
 public:
  Hanging(const HungTagsConfig& config, const HomeToTag& home, std::uint64_t seed)
      : config_(config), faces_(home.walls), furniture_(home.furniture), random_(seed, 3) {
    for (const HomeFurniture& piece : home.furniture)
      if (!piece.is_round) std::ranges::copy(free_sides(piece.box, home.rooms), std::back_inserter(faces_));
    for (const HomeFace& face : faces_) all_m_ += (face.b_m - face.a_m).norm();
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
      return std::ranges::any_of(
          furniture_, [&](const HomeFurniture& piece) { return piece.box.contains(at_m + before_m * normal); });
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
  std::vector<HomeFace> faces_;
  const std::vector<HomeFurniture>& furniture_;
  PortableRandom random_;
  double all_m_ = 0.0;
  std::vector<WorldTag> tags_;
};

}  // namespace

std::string hung_tags_yaml(const HungTagsConfig& config, const HomeToTag& home, std::uint64_t seed) {
  if (config.count == 0) return {};
  std::string text = "tags:\n";
  for (const WorldTag& tag : Hanging(config, home, seed).draw())
    text += fmt::format("  - {{id: {}, at_m: [{:.3f}, {:.3f}], facing_deg: {:g}, height_m: {:.3f}, size_m: {:g}}}\n",
                        tag.marker.number, tag.T_map_tag.x_m, tag.T_map_tag.y_m,
                        std::round(degrees(tag.T_map_tag.theta_rad)), tag.height_m, tag.size_m);
  return text;
}

}  // namespace cairn
