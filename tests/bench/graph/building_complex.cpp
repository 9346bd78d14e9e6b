#include "tests/bench/graph/building_complex.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace cairn {
namespace {

constexpr int kCorridors = 4;
constexpr int kJunctions = 10;  // of a corridor
constexpr double kStep_m = 6.0;
constexpr double kFloor_m = 4.0;
constexpr std::size_t kFloorLandmarks = kCorridors * kJunctions * 3;

class Complex {
 public:
  explicit Complex(std::uint64_t seed) : random_(seed) {}

  LandmarkGraph built(std::size_t landmarks) {
    const std::size_t floors = std::max<std::size_t>(1, landmarks / kFloorLandmarks);
    const int height = static_cast<int>(std::clamp<std::size_t>(floors / 4, 1, 10));
    const auto buildings =
        static_cast<int>((floors + static_cast<std::size_t>(height) - 1) / static_cast<std::size_t>(height));
    const int side = static_cast<int>(std::ceil(std::sqrt(buildings)));
    std::vector<std::vector<LandmarkId>> doors;  // of each building, one a floor, the lowest first
    for (int b = 0; b < buildings; ++b) {
      const Point corner(80.0 * (b % side), 60.0 * (b / side));
      const int floors_left = static_cast<int>(floors) - b * height;
      doors.push_back(building(corner, std::min(height, floors_left)));
      if (b % side > 0) path(doors[static_cast<std::size_t>(b - 1)], doors.back());
      if (b >= side) path(doors[static_cast<std::size_t>(b - side)], doors.back());
    }
    return std::move(graph_);
  }

 private:
  double share() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

  LandmarkId landmark(double x_m, double y_m, int level, const char* category) {
    Landmark landmark;
    landmark.category = category;
    landmark.T_map_landmark = {x_m, y_m, 0.0};
    landmark.level = level;
    return graph_.add(std::move(landmark));
  }
  void join(LandmarkId a, LandmarkId b) {
    const Landmark& at = *graph_.find(a);
    const Landmark& to = *graph_.find(b);
    const double flat_m = (at.T_map_landmark.position() - to.T_map_landmark.position()).norm();
    const double straight_m = std::hypot(flat_m, kFloor_m * (at.level - to.level));
    const bool both_ways = share() > 1.0 / 30.0;
    for (const auto& [from, end] : {std::pair(a, b), std::pair(b, a)}) {
      Route route;
      route.from = from;
      route.to = end;
      route.cost_m = straight_m * (1.0 + 0.3 * share());
      graph_.add_route(std::move(route));
      if (!both_ways) break;
    }
  }

  // Gives the way in.
  std::vector<LandmarkId> building(const Point& corner, int floors) {
    std::vector<LandmarkId> below;
    std::vector<LandmarkId> doors;
    for (int level = 0; level < floors; ++level) {
      const std::vector<LandmarkId> halls = floor(corner, level);
      if (!below.empty()) {  // stairs at two corners
        join(below.front(), halls.front());
        join(below.back(), halls.back());
      }
      doors.push_back(halls.front());
      below = halls;
    }
    return doors;
  }

  // Gives the junctions, corridor by corridor.
  std::vector<LandmarkId> floor(const Point& corner, int level) {
    std::vector<LandmarkId> halls;
    for (int c = 0; c < kCorridors; ++c) {
      std::vector<LandmarkId> rooms;
      for (int j = 0; j < kJunctions; ++j) {
        const double x_m = corner.x() + kStep_m * j;
        const double y_m = corner.y() + 12.0 * c;
        const LandmarkId hall = landmark(x_m, y_m, level, "junction");
        if (j > 0) join(halls.back(), hall);
        if (c > 0 && (j == 0 || j == kJunctions - 1 || j == kJunctions / 2))
          join(halls[halls.size() - kJunctions], hall);
        halls.push_back(hall);
        for (const double aside_m : {-3.0, 3.0}) {
          const LandmarkId room = landmark(x_m, y_m + aside_m, level, "room");
          join(hall, room);
          if (rooms.size() > 1 && share() < 0.2) join(rooms[rooms.size() - 2], room);
          rooms.push_back(room);
        }
      }
    }
    return halls;
  }

  void path(const std::vector<LandmarkId>& from, const std::vector<LandmarkId>& to) {
    join(from.front(), to.front());
    const std::size_t common = std::min(from.size(), to.size());
    if (common > 3 && share() < 0.3) join(from[3], to[3]);  // a bridge
  }

  std::mt19937_64 random_;
  LandmarkGraph graph_;
};

}  // namespace

LandmarkGraph building_complex(std::size_t landmarks, std::uint64_t seed) {
  return Complex(seed).built(landmarks);
}

}  // namespace cairn
