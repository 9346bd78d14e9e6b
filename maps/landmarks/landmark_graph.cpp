#include "maps/landmarks/landmark_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

// Ids travel as JSON numbers, which are exact up to here only.
constexpr std::int64_t kMaxId = (std::int64_t{1} << 53) - 1;

std::string named(const char* kind, std::int64_t id) {
  return fmt::format("{} {}", kind, id);
}

// Takes the next free id, or keeps the given one and moves the next beyond it.
std::int64_t claim_id(const char* kind, std::int64_t id, std::int64_t& next) {
  if (id == 0) id = next;
  if (id < 0 || id > kMaxId)
    throw std::invalid_argument(fmt::format("{}: an id must be in 1..{}", named(kind, id), kMaxId));
  next = std::max(next, id + 1);
  return id;
}

// The number in "L<number>" as label_of writes it; 0 for any other text.
LandmarkId id_in_label(const std::string& label) {
  LandmarkId id = 0;
  if (label.size() < 2 || label[0] != 'L' || label[1] < '1' || label[1] > '9') return 0;
  const char* const end = label.data() + label.size();
  const auto [rest, error] = std::from_chars(label.data() + 1, end, id);
  return error == std::errc{} && rest == end ? id : 0;
}

void check_cost(RouteId id, double cost_m) {
  if (!std::isfinite(cost_m) || cost_m < 0.0)
    throw std::invalid_argument(
        fmt::format("{}: cost_m must be finite and not negative, got {:f}", named("route", id), cost_m));
}

void insert_sorted(std::vector<RouteId>& ids, RouteId id) {
  ids.insert(std::upper_bound(ids.begin(), ids.end(), id), id);
}

// What is loaded comes by rising id, and then nothing has to be looked for.
template <class Value>
bool holds(const std::map<std::int64_t, Value>& values, std::int64_t id) {
  return !values.empty() && id <= values.rbegin()->first && values.contains(id);
}

const std::vector<RouteId> kNoRoutes;

}  // namespace

std::vector<Pose2> in_whole_steps(std::vector<Pose2> trajectory) {
  // Adding 0.0 makes 0.0 of -0.0.
  const auto rounded = [](double value) { return std::round(value * kTrajectorySteps) / kTrajectorySteps + 0.0; };
  for (Pose2& pose : trajectory) pose = {rounded(pose.x_m), rounded(pose.y_m), rounded(pose.theta_rad)};
  return trajectory;
}

void LandmarkGraph::check(const Landmark& landmark) const {
  if (holds(landmarks_, landmark.id) || holds(retired_, landmark.id))
    throw std::invalid_argument(named("landmark", landmark.id) + " exists already");
  if (!is_finite(landmark.T_map_landmark) || (landmark.access && !is_finite(*landmark.access)))
    throw std::invalid_argument(named("landmark", landmark.id) + ": its place is not finite");
}

LandmarkId LandmarkGraph::add(Landmark landmark) {
  check(landmark);
  landmark.id = claim_id("landmark", landmark.id, next_landmark_);
  const LandmarkId id = landmark.id;
  landmarks_.emplace_hint(landmarks_.end(), id, std::move(landmark));
  return id;
}

RouteId LandmarkGraph::add_route(Route route) {
  if (holds(routes_, route.id)) throw std::invalid_argument(named("route", route.id) + " exists already");
  const auto out = touching_.find(route.from);
  const auto in = touching_.find(route.to);
  for (const auto& [end, touching] : {std::pair(route.from, out), std::pair(route.to, in)})
    if (touching == touching_.end() && !landmarks_.contains(end))
      throw std::invalid_argument(named("route", route.id) + ": there is no " + named("landmark", end));
  check_cost(route.id, route.cost_m);
  if (route.speed_limit_mps && !(*route.speed_limit_mps > 0.0 && std::isfinite(*route.speed_limit_mps)))
    throw std::invalid_argument(named("route", route.id) + ": its speed limit must be finite and above 0");
  for (const Pose2& pose : route.trajectory)
    if (!is_finite(pose)) throw std::invalid_argument(named("route", route.id) + ": its trajectory is not finite");
  route.id = claim_id("route", route.id, next_route_);
  const RouteId id = route.id;
  insert_sorted((out == touching_.end() ? touching_[route.from] : out->second).out, id);
  insert_sorted((in == touching_.end() ? touching_[route.to] : in->second).in, id);
  routes_.emplace_hint(routes_.end(), id, std::move(route));
  return id;
}

void LandmarkGraph::remove(LandmarkId id) {
  if (!landmarks_.contains(id)) throw std::invalid_argument("there is no " + named("landmark", id) + " to remove");
  if (const auto found = touching_.find(id); found != touching_.end()) {
    const Touching routes = found->second;  // removing them changes it
    for (const RouteId route : routes.out) remove_route(route);
    for (const RouteId route : routes.in)
      if (routes_.contains(route)) remove_route(route);
  }
  landmarks_.erase(id);
}

void LandmarkGraph::retire(LandmarkId id, std::string reason) {
  const Landmark* const landmark = find(id);
  if (landmark == nullptr) throw std::invalid_argument("there is no " + named("landmark", id) + " to retire");
  RetiredLandmark retired{*landmark, std::move(reason)};
  remove(id);
  retired_.emplace(id, std::move(retired));
}

void LandmarkGraph::add_retired(RetiredLandmark retired) {
  check(retired.landmark);
  if (retired.landmark.id == 0) throw std::invalid_argument("a retired landmark keeps its id, 0 is none");
  const LandmarkId id = claim_id("landmark", retired.landmark.id, next_landmark_);
  retired_.emplace(id, std::move(retired));
}

void LandmarkGraph::remove_route(RouteId id) {
  const auto found = routes_.find(id);
  if (found == routes_.end()) throw std::invalid_argument("there is no " + named("route", id) + " to remove");
  for (const LandmarkId end : {found->second.from, found->second.to}) {
    const auto touching = touching_.find(end);
    if (touching == touching_.end()) continue;  // both ends are one landmark
    std::erase(touching->second.out, id);
    std::erase(touching->second.in, id);
    if (touching->second.out.empty() && touching->second.in.empty()) touching_.erase(touching);
  }
  routes_.erase(found);
}

void LandmarkGraph::set_closed(RouteId id, bool closed) {
  const auto found = routes_.find(id);
  if (found == routes_.end()) throw std::invalid_argument("there is no " + named("route", id) + " to close or open");
  found->second.closed = closed;
}

void LandmarkGraph::set_cost(RouteId id, double cost_m) {
  const auto found = routes_.find(id);
  if (found == routes_.end()) throw std::invalid_argument("there is no " + named("route", id) + " to give a cost");
  check_cost(id, cost_m);
  found->second.cost_m = cost_m;
}

void LandmarkGraph::reserve_ids(LandmarkId next_landmark, RouteId next_route) {
  if (next_landmark > kMaxId + 1 || next_route > kMaxId + 1)
    throw std::invalid_argument(
        fmt::format("reserve_ids: ids end at {}, asked for {} and {}", kMaxId, next_landmark, next_route));
  next_landmark_ = std::max(next_landmark_, next_landmark);
  next_route_ = std::max(next_route_, next_route);
}

const Landmark* LandmarkGraph::find(LandmarkId id) const {
  const auto found = landmarks_.find(id);
  return found == landmarks_.end() ? nullptr : &found->second;
}

Landmark* LandmarkGraph::find(LandmarkId id) {
  const auto found = landmarks_.find(id);
  return found == landmarks_.end() ? nullptr : &found->second;
}

const Landmark* LandmarkGraph::find_by_name(const std::string& name_or_id) const {
  if (const Landmark* landmark = find(id_in_label(name_or_id))) return landmark;
  if (name_or_id.empty()) return nullptr;
  for (const auto& [id, landmark] : landmarks_)
    if (landmark.name == name_or_id) return &landmark;
  const std::optional<MarkerName> marker = marker_name_in(name_or_id);
  if (!marker) return nullptr;
  if (marker->family) return find_marker({*marker->family, marker->number});
  for (const MarkerFamily family : kMarkerFamilies)
    if (const Landmark* landmark = find_marker({family, marker->number})) return landmark;
  return nullptr;
}

const Landmark* LandmarkGraph::find_marker(const MarkerId& marker) const {
  const auto found = std::ranges::find_if(landmarks_, [&](const auto& entry) { return entry.second.marker == marker; });
  return found == landmarks_.end() ? nullptr : &found->second;
}

const Route* LandmarkGraph::find_route(RouteId id) const {
  const auto found = routes_.find(id);
  return found == routes_.end() ? nullptr : &found->second;
}

const Landmark* LandmarkGraph::nearest(const Point& p_map, double within_m) const {
  const Landmark* best = nullptr;
  double best_m = within_m;
  for (const auto& [id, landmark] : landmarks_) {
    const double distance_m = (landmark.T_map_landmark.position() - p_map).norm();
    if (best == nullptr ? distance_m <= best_m : distance_m < best_m) {
      best = &landmark;
      best_m = distance_m;
    }
  }
  return best;
}

std::vector<LandmarkId> LandmarkGraph::of_category(const std::string& category) const {
  std::vector<LandmarkId> ids;
  for (const auto& [id, landmark] : landmarks_)
    if (landmark.category == category) ids.push_back(id);
  return ids;
}

const std::vector<RouteId>& LandmarkGraph::routes_from(LandmarkId id) const {
  const auto found = touching_.find(id);
  return found == touching_.end() ? kNoRoutes : found->second.out;
}

const std::vector<RouteId>& LandmarkGraph::routes_to(LandmarkId id) const {
  const auto found = touching_.find(id);
  return found == touching_.end() ? kNoRoutes : found->second.in;
}

const Route* LandmarkGraph::route_between(LandmarkId from, LandmarkId to) const {
  const Route* best = nullptr;
  for (const RouteId id : routes_from(from)) {
    const Route& route = routes_.at(id);
    if (route.to == to && !route.closed && (best == nullptr || route.cost_m < best->cost_m)) best = &route;
  }
  return best;
}

std::string label_of(const Landmark& landmark) {
  if (!landmark.name.empty()) return landmark.name;
  return landmark.marker ? text_of(*landmark.marker) : fmt::format("L{}", landmark.id);
}

}  // namespace cairn
