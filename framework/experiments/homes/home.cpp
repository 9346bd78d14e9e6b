#include "framework/experiments/homes/home.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "framework/experiments/homes/hung_tags.hpp"
#include "maps/base/portable_random.hpp"

namespace cairn {
namespace {

constexpr double kMinSide_m = 2.2;
constexpr double kBesideDoor_m = 0.25;  // of wall
constexpr double kBeforeDoor_m = 0.9;

struct Piece {
  std::string outline;
  HomeFurniture shape;
};

// A side that two rooms share, before their walls are taken off.
struct SharedSide {
  int rooms[2];
  bool is_upright;  // along y
  double at_m;
  double from_m;
  double to_m;
};

class HomeDrawing {
 public:
  HomeDrawing(const HomesConfig& config, std::uint64_t seed)
      : config_(config), seed_(seed), layout_(seed, 1), things_(seed, 2) {}

  [[nodiscard]] Home draw() {
    const double area_m2 = layout_.between(config_.min_area_m2, config_.max_area_m2);
    const int rooms = layout_.whole(config_.min_rooms, config_.max_rooms);
    const double width_m = std::sqrt(area_m2 * layout_.between(1.0, 1.8));
    size_m_ = {width_m, area_m2 / width_m};
    if (rooms >= 4 && layout_.share() < config_.corridor_ratio && size_m_.y() > 2.0 * kMinSide_m + kCorridor_m.second)
      along_corridor(rooms - 1);
    else
      divided(rooms);
    join();
    furnish();
    start();
    home_.world_yaml = yaml();
    return std::move(home_);
  }

 private:
  static constexpr std::pair<double, double> kCorridor_m{1.2, 1.6};

  // Rooms on both sides of a corridor from wall to wall.
  void along_corridor(int rooms) {
    const double corridor_m = layout_.between(kCorridor_m.first, kCorridor_m.second);
    const double south_m = (size_m_.y() - corridor_m) * layout_.between(0.42, 0.58);
    whole_.push_back({{0.0, south_m}, {size_m_.x(), south_m + corridor_m}});
    const int south = rooms / 2;
    row(south, 0.0, south_m);
    row(rooms - south, south_m + corridor_m, size_m_.y());
    has_corridor_ = true;
  }

  void row(int rooms, double from_m, double to_m) {
    rooms = std::max(1, std::min(rooms, static_cast<int>(size_m_.x() / kMinSide_m)));
    std::vector<double> shares(static_cast<std::size_t>(rooms));
    for (double& share : shares) share = layout_.between(0.0, 1.0);
    const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
    const double spare_m = size_m_.x() - rooms * kMinSide_m;
    double x_m = 0.0;
    for (const double share : shares) {
      const double next_m = x_m + kMinSide_m + spare_m * share / all;
      whole_.push_back({{x_m, from_m}, {next_m, to_m}});
      x_m = next_m;
    }
  }

  // The largest room is divided until there are enough; a corner room may be left out.
  void divided(int rooms) {
    const bool lacks_corner = layout_.share() < config_.corner_ratio;
    whole_.push_back({{0.0, 0.0}, size_m_});
    while (static_cast<int>(whole_.size()) < rooms + (lacks_corner ? 1 : 0)) {
      const auto largest = std::ranges::max_element(whole_, {}, [](const HomeRoom& room) {
        return (room.max_m - room.min_m).maxCoeff() + 0.1 * (room.max_m - room.min_m).prod();
      });
      const Point side_m = largest->max_m - largest->min_m;
      const int axis = side_m.x() > side_m.y() ? 0 : 1;
      if (side_m[axis] < 2.0 * kMinSide_m) break;
      const double cut_m = largest->min_m[axis] + std::clamp(side_m[axis] * layout_.between(0.38, 0.62), kMinSide_m,
                                                             side_m[axis] - kMinSide_m);
      HomeRoom other = *largest;
      largest->max_m[axis] = cut_m;
      other.min_m[axis] = cut_m;
      whole_.push_back(other);
    }
    if (lacks_corner && whole_.size() > 3) leave_out_corner();
  }

  void leave_out_corner() {
    const auto corner = std::ranges::find_if(whole_, [&](const HomeRoom& room) {
      return std::abs(room.max_m.x() - size_m_.x()) < 1e-9 && std::abs(room.max_m.y() - size_m_.y()) < 1e-9;
    });
    const HomeRoom left_out = *corner;
    whole_.erase(corner);
    if (!are_joined(shared_sides())) whole_.push_back(left_out);
  }

  [[nodiscard]] std::vector<SharedSide> shared_sides() const {
    std::vector<SharedSide> sides;
    const double min_m = config_.max_door_m + 2.0 * kBesideDoor_m + config_.wall_m;
    for (int a = 0; a < static_cast<int>(whole_.size()); ++a)
      for (int b = 0; b < static_cast<int>(whole_.size()); ++b)
        for (const int axis : {0, 1}) {
          const HomeRoom& one = whole_[static_cast<std::size_t>(a)];
          const HomeRoom& two = whole_[static_cast<std::size_t>(b)];
          if (a == b || std::abs(one.max_m[axis] - two.min_m[axis]) > 1e-9) continue;
          const double from_m = std::max(one.min_m[1 - axis], two.min_m[1 - axis]);
          const double to_m = std::min(one.max_m[1 - axis], two.max_m[1 - axis]);
          if (to_m - from_m >= min_m) sides.push_back({{a, b}, axis == 0, one.max_m[axis], from_m, to_m});
        }
    return sides;
  }

  [[nodiscard]] static int root_of(const std::vector<int>& parent, int room) {
    while (parent[static_cast<std::size_t>(room)] != room) room = parent[static_cast<std::size_t>(room)];
    return room;
  }
  [[nodiscard]] std::vector<int> alone() const {
    std::vector<int> parent(whole_.size());
    std::iota(parent.begin(), parent.end(), 0);
    return parent;
  }
  [[nodiscard]] bool are_joined(const std::vector<SharedSide>& sides) const {
    std::vector<int> parent = alone();
    for (const SharedSide& side : sides)
      parent[static_cast<std::size_t>(root_of(parent, side.rooms[0]))] = root_of(parent, side.rooms[1]);
    const int root = root_of(parent, 0);
    for (int i = 0; i < static_cast<int>(whole_.size()); ++i)
      if (root_of(parent, i) != root) return false;
    return true;
  }

  // Doors of a random spanning tree; of a home with a corridor, to the corridor first. A few more besides.
  void join() {
    for (const HomeRoom& room : whole_) {
      const Point half_wall_m = Point::Constant(0.5 * config_.wall_m);
      home_.rooms.push_back({room.min_m + half_wall_m, room.max_m - half_wall_m});
    }
    std::vector<std::pair<double, SharedSide>> order;
    for (const SharedSide& side : shared_sides()) {
      const bool to_corridor = has_corridor_ && (side.rooms[0] == 0 || side.rooms[1] == 0);
      order.emplace_back(layout_.share() + (to_corridor ? -1.0 : 0.0), side);
    }
    std::ranges::sort(order, {}, &std::pair<double, SharedSide>::first);
    std::vector<int> parent = alone();
    for (const auto& [rank, side] : order) {
      const int one = root_of(parent, side.rooms[0]);
      const int two = root_of(parent, side.rooms[1]);
      const bool is_extra = one == two && layout_.share() < 0.15;
      if (one == two && !is_extra) continue;
      parent[static_cast<std::size_t>(one)] = two;
      const double width_m = layout_.between(config_.min_door_m, config_.max_door_m);
      const double margin_m = 0.5 * width_m + kBesideDoor_m + 0.5 * config_.wall_m;
      const double along_m = layout_.between(side.from_m + margin_m, side.to_m - margin_m);
      const Point middle_m = side.is_upright ? Point(side.at_m, along_m) : Point(along_m, side.at_m);
      home_.doors.push_back({middle_m, width_m, {side.rooms[0], side.rooms[1]}, side.is_upright});
      sides_.push_back(side);
    }
  }

  [[nodiscard]] bool has_place(const HomeRoom& box, const HomeRoom& room) const {
    const auto gap_m = [](const HomeRoom& a, const HomeRoom& b) {
      const Point apart = (a.min_m - b.max_m).cwiseMax(b.min_m - a.max_m).cwiseMax(Point(0.0, 0.0));
      return apart.norm();
    };
    for (const int axis : {0, 1}) {
      const double before_m = box.min_m[axis] - room.min_m[axis];
      const double behind_m = room.max_m[axis] - box.max_m[axis];
      if (before_m < -1e-9 || behind_m < -1e-9) return false;
      if (before_m > 1e-6 && before_m < config_.gap_m) return false;
      if (behind_m > 1e-6 && behind_m < config_.gap_m) return false;
      if (before_m < 1e-6 && behind_m < 1e-6) return false;
    }
    for (const HomeDoor& door : home_.doors) {
      const Point reach = Point::Constant(0.5 * door.width_m + 0.1);
      const Point before = Point::Constant(kBeforeDoor_m);
      const HomeRoom kept{door.middle_m - reach.cwiseMax(before), door.middle_m + reach.cwiseMax(before)};
      if (gap_m(kept, box) <= 0.0) return false;
    }
    return std::ranges::none_of(pieces_,
                                [&](const Piece& piece) { return gap_m(piece.shape.box, box) < config_.gap_m; });
  }

  // Against a wall or in a corner: cupboards, beds, sofas. Free: tables, and round ones.
  [[nodiscard]] std::optional<Piece> piece_in(const HomeRoom& room) {
    constexpr int kTries = 30;
    const int kind = things_.whole(0, 3);
    Point size_m{things_.between(0.5, 1.8), things_.between(0.35, 0.9)};
    if (kind >= 2) size_m = Point(things_.between(0.5, 1.2), things_.between(0.5, 0.8));
    if (kind == 3) size_m = Point::Constant(things_.between(0.35, 0.9));
    if (things_.share() < 0.5) std::swap(size_m.x(), size_m.y());
    for (int t = 0; t < kTries; ++t) {
      const Point spare_m = room.max_m - room.min_m - size_m;
      if (spare_m.minCoeff() < config_.gap_m) return std::nullopt;
      Point at_m{things_.between(0.0, spare_m.x()), things_.between(0.0, spare_m.y())};
      if (kind < 2) at_m[kind] = things_.share() < 0.5 ? 0.0 : spare_m[kind];
      if (kind < 2 && things_.share() < 0.4) at_m[1 - kind] = things_.share() < 0.5 ? 0.0 : spare_m[1 - kind];
      const HomeRoom box{room.min_m + at_m, room.min_m + at_m + size_m};
      if (!has_place(box, room)) continue;
      if (kind == 3) {
        const Point middle_m = 0.5 * (box.min_m + box.max_m);
        return Piece{
            fmt::format("circle_diameter_m: {:.3f}, at_m: [{:.3f}, {:.3f}]", size_m.x(), middle_m.x(), middle_m.y()),
            {box, true}};
      }
      return Piece{fmt::format("polygon_m: [[{0:.3f}, {1:.3f}], [{2:.3f}, {1:.3f}], [{2:.3f}, {3:.3f}], [{0:.3f}, "
                               "{3:.3f}]]",
                               box.min_m.x(), box.min_m.y(), box.max_m.x(), box.max_m.y()),
                   {box, false}};
    }
    return std::nullopt;
  }

  void furnish() {
    for (std::size_t i = has_corridor_ ? 1 : 0; i < home_.rooms.size(); ++i) {
      const int count = things_.whole(0, config_.max_furniture);
      for (int k = 0; k < count; ++k)
        if (const std::optional<Piece> piece = piece_in(home_.rooms[i])) pieces_.push_back(*piece);
    }
  }

  void start() {
    constexpr double kRoom_m = 0.5;
    constexpr int kTries = 1000;
    for (int t = 0; t < kTries; ++t) {
      const HomeRoom& room =
          home_.rooms[static_cast<std::size_t>(things_.whole(0, static_cast<int>(home_.rooms.size()) - 1))];
      home_.start_m.x() = things_.between(room.min_m.x() + kRoom_m, room.max_m.x() - kRoom_m);
      home_.start_m.y() = things_.between(room.min_m.y() + kRoom_m, room.max_m.y() - kRoom_m);
      const bool is_free = std::ranges::none_of(pieces_, [&](const Piece& piece) {
        const Point apart = (piece.shape.box.min_m - home_.start_m).cwiseMax(home_.start_m - piece.shape.box.max_m);
        return apart.maxCoeff() < kRoom_m;
      });
      if (is_free) break;
    }
    home_.start_deg = std::floor(things_.between(0.0, 360.0));
  }

  // The side of a room between its walls, with its doors left out; the room lies to the left.
  [[nodiscard]] std::vector<HomeFace> side_of(std::size_t room, int axis, bool is_high) const {
    const HomeRoom& box = home_.rooms[room];
    const double at_m = is_high ? box.max_m[axis] : box.min_m[axis];
    std::vector<std::pair<double, double>> gaps;
    for (const HomeDoor& door : home_.doors) {
      const bool is_mine = door.rooms[0] == static_cast<int>(room) || door.rooms[1] == static_cast<int>(room);
      const double along_m = door.middle_m[1 - axis];
      if (is_mine && std::abs(door.middle_m[axis] - at_m) < config_.wall_m)
        gaps.emplace_back(along_m - 0.5 * door.width_m, along_m + 0.5 * door.width_m);
    }
    std::ranges::sort(gaps);
    double from_m = box.min_m[1 - axis];
    gaps.emplace_back(box.max_m[1 - axis], 0.0);
    std::vector<HomeFace> faces;
    faces.reserve(gaps.size());
    for (const auto& [gap_from_m, gap_to_m] : gaps) {
      HomeFace face{{at_m, from_m}, {at_m, gap_from_m}};
      if (axis == 1) face = {{from_m, at_m}, {gap_from_m, at_m}};
      if (is_high == (axis == 1)) std::swap(face.a_m, face.b_m);
      faces.push_back(face);
      from_m = gap_to_m;
    }
    return faces;
  }

  [[nodiscard]] std::vector<HomeFace> sides() const {
    std::vector<HomeFace> all;
    for (std::size_t i = 0; i < home_.rooms.size(); ++i)
      for (const int axis : {0, 1})
        for (const bool is_high : {false, true}) std::ranges::copy(side_of(i, axis, is_high), std::back_inserter(all));
    return all;
  }

  [[nodiscard]] static std::string line(const Point& from_m, const Point& to_m) {
    return fmt::format("  - {{points_m: [[{:.3f}, {:.3f}], [{:.3f}, {:.3f}]], surface: rough}}\n", from_m.x(),
                       from_m.y(), to_m.x(), to_m.y());
  }

  [[nodiscard]] std::string yaml() const {
    std::string text = fmt::format("# A random home: {} rooms, {} doors.\n", home_.rooms.size(), home_.doors.size());
    text += fmt::format("bounds_m: [[0, 0], [{:.3f}, {:.3f}]]\nwalls:\n", size_m_.x(), size_m_.y());
    for (const HomeFace& side : sides()) text += line(side.a_m.cwiseMin(side.b_m), side.a_m.cwiseMax(side.b_m));
    for (std::size_t i = 0; i < home_.doors.size(); ++i)  // the jambs
      for (const double side : {-0.5, 0.5}) {
        const HomeDoor& door = home_.doors[i];
        const bool is_upright = sides_[i].is_upright;
        const double along_m = side * door.width_m;
        const Point jamb_m = door.middle_m + (is_upright ? Point(0.0, along_m) : Point(along_m, 0.0));
        const Point half_m = 0.5 * config_.wall_m * (is_upright ? Point(1.0, 0.0) : Point(0.0, 1.0));
        text += line(jamb_m - half_m, jamb_m + half_m);
      }
    if (!pieces_.empty()) text += "objects:\n";
    for (const Piece& piece : pieces_) text += "  - {" + piece.outline + ", surface: rough}\n";
    std::vector<HomeFurniture> furniture;
    furniture.reserve(pieces_.size());
    for (const Piece& piece : pieces_) furniture.push_back(piece.shape);
    return text + hung_tags_yaml({config_.tags, config_.tag_size_m}, {home_.rooms, sides(), furniture}, seed_);
  }

  HomesConfig config_;
  std::uint64_t seed_;
  PortableRandom layout_;
  PortableRandom things_;
  Point size_m_{0.0, 0.0};
  std::vector<HomeRoom> whole_;    // with half of their walls
  bool has_corridor_ = false;      // the first room
  std::vector<SharedSide> sides_;  // of the doors
  std::vector<Piece> pieces_;
  Home home_;
};

}  // namespace

Home random_home(const HomesConfig& config, std::uint64_t seed) {
  return HomeDrawing(config, seed).draw();
}

}  // namespace cairn
