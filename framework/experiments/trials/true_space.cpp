#include "framework/experiments/trials/true_space.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

constexpr double kCell_m = 0.05;

double object_distance_m(const WorldObject& object, const Point& p_m) {
  return object.contour.signed_distance(inverse(object.T_map_object) * p_m);
}

}  // namespace

TrueSpace::TrueSpace(const World& world, double radius_m) : world_(world), radius_m_(radius_m) {
  const Point size_m = world.max_m - world.min_m;
  width_ = std::max(0, static_cast<int>(std::ceil(size_m.x() / kCell_m)));
  height_ = std::max(0, static_cast<int>(std::ceil(size_m.y() / kCell_m)));
  free_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (std::size_t cell = 0; cell < free_.size(); ++cell) free_[cell] = has_room(centre_of(cell));
}

bool TrueSpace::has_room(const Point& p_m) const {
  if ((p_m.array() < world_.min_m.array()).any() || (p_m.array() > world_.max_m.array()).any()) return false;
  for (const WorldWall& wall : world_.walls)
    for (std::size_t i = 1; i < wall.points_m.size(); ++i)
      if (distance_to_segment_m(p_m, wall.points_m[i - 1], wall.points_m[i]) < radius_m_) return false;
  return std::ranges::none_of(world_.objects,
                              [&](const WorldObject& object) { return object_distance_m(object, p_m) < radius_m_; });
}

Point TrueSpace::centre_of(std::size_t cell) const {
  const std::lldiv_t row = std::lldiv(static_cast<long long>(cell), width_);
  return world_.min_m + kCell_m * Point(static_cast<double>(row.rem) + 0.5, static_cast<double>(row.quot) + 0.5);
}

double TrueSpace::cell_m() {
  return kCell_m;
}

std::vector<Point> TrueSpace::reached_from(const Point& p_m) const {
  std::vector<int> part(free_.size(), 0);
  constexpr int kNotYet = -1;
  for (std::size_t cell = 0; cell < part.size(); ++cell) part[cell] = free_[cell] ? kNotYet : 0;
  for (const std::size_t from : cells_near(p_m, kCell_m))
    if (part[from] == kNotYet) fill(part, from, 1);
  std::vector<Point> places;
  for (std::size_t cell = 0; cell < part.size(); ++cell)
    if (part[cell] == 1) places.push_back(centre_of(cell));
  return places;
}

TrueSpace::Cells TrueSpace::cells_near(const Point& p_m, double within_m) const {
  Cells cells;
  for (std::size_t cell = 0; cell < free_.size(); ++cell)
    if (free_[cell] && (centre_of(cell) - p_m).norm() <= within_m) cells.push_back(cell);
  return cells;
}

TrueSpace::Cells TrueSpace::cells_beside(const WorldObject& object, double within_m) const {
  Cells cells;
  for (std::size_t cell = 0; cell < free_.size(); ++cell)
    if (free_[cell] && object_distance_m(object, centre_of(cell)) <= within_m) cells.push_back(cell);
  return cells;
}

TrueSpace::Doors TrueSpace::doors_at(double time_s) const {
  Doors closed;
  for (const WorldDoor& door : world_.doors) closed.push_back(door.closes_at(time_s));
  return closed;
}

bool TrueSpace::joined(const Cells& from, const Cells& to, const Doors& closed) {
  const std::vector<int>& part = parts(closed);
  return std::ranges::any_of(from, [&](std::size_t a) {
    return part[a] > 0 && std::ranges::any_of(to, [&](std::size_t b) { return part[b] == part[a]; });
  });
}

const std::vector<int>& TrueSpace::parts(const Doors& closed) {
  const auto [found, is_new] = parts_.try_emplace(closed, free_.size(), 0);
  std::vector<int>& part = found->second;
  if (!is_new) return part;
  constexpr int kNotYet = -1;
  for (std::size_t cell = 0; cell < free_.size(); ++cell) {
    bool is_free = free_[cell];
    for (std::size_t i = 0; i < closed.size() && is_free; ++i)
      is_free = !closed[i] ||
                distance_to_segment_m(centre_of(cell), world_.doors[i].from_m, world_.doors[i].to_m) >= radius_m_;
    part[cell] = is_free ? kNotYet : 0;
  }
  int number = 0;
  for (std::size_t cell = 0; cell < part.size(); ++cell)
    if (part[cell] == kNotYet) fill(part, cell, ++number);
  return part;
}

void TrueSpace::fill(std::vector<int>& part, std::size_t from, int number) const {
  std::vector<std::size_t> open{from};
  part[from] = number;
  const std::size_t width = static_cast<std::size_t>(width_);
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    const std::size_t none = std::numeric_limits<std::size_t>::max();
    const std::array<std::size_t, 4> beside{at % width > 0 ? at - 1 : none, at % width + 1 < width ? at + 1 : none,
                                            at >= width ? at - width : none, at + width};
    for (const std::size_t next : beside)
      if (next < part.size() && part[next] < 0) {
        part[next] = number;
        open.push_back(next);
      }
  }
}

}  // namespace cairn
