#include "plugins/behaviours/errands/visits.hpp"

#include <algorithm>

#include "maps/base/text.hpp"
#include "plugins/behaviours/errands/visiting_order.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kUnreached_m = 1e6;  // such places come last

}  // namespace

std::vector<PlaceName> to_place_names(const ConfigValue& value, const std::string& key) {
  std::vector<PlaceName> places;
  for (const ConfigValue& item : config_detail::to_list(value, key)) places.push_back(to_place_name(item, key));
  if (places.empty() || places.size() > kMaxPlaces)
    throw ConfigError(value.place, key + " must be a list of 1 to " + std::to_string(kMaxPlaces) + " places, found " +
                                       (places.empty() ? "an empty list" : std::to_string(places.size())));
  return places;
}

Visits::Visits(const VisitSettings& settings, std::uint64_t seed, std::vector<PlaceName> places, Unknown unknown)
    : settings_(settings),
      seed_(seed),
      driver_(settings, seed),
      if_unknown_(unknown),
      ordered_(settings.order == VisitOrder::given || places.size() == 1) {
  for (PlaceName& name : places) stops_.push_back({std::move(name), std::nullopt});
}

Status Visits::tick(const WorldView& world, BehaviourContext& context) {
  if (!ordered_) return find_order(world, context);
  if (waiting_since_s_) return wait(world);
  return drive(world, context);
}

Place Visits::place_of(const Stop& stop, const WorldView& world) const {
  if (stop.chosen && world.graph.find(*stop.chosen) != nullptr) {
    Place place;
    place.landmarks = {*stop.chosen};
    return place;
  }
  return find_place(stop.name, world).place;
}

Status Visits::find_order(const WorldView& world, BehaviourContext& context) {
  const std::size_t all = stops_.size() + 1;
  if (cost_m_.empty()) cost_m_.assign(all, std::vector<double>(all, 0.0));
  if (from_ + 1 < all) {
    ask_next_length(world, context);
    return {StepState::running, "asking for the routes between " + std::to_string(all - 1) + " places"};
  }
  std::vector<Stop> in_order;
  for (const std::size_t stop : shortest_order(cost_m_)) in_order.push_back(stops_[stop - 1]);
  stops_ = std::move(in_order);
  ordered_ = true;
  std::vector<std::string> names;
  for (const Stop& stop : stops_) names.push_back(stop.chosen ? "L" + std::to_string(*stop.chosen) : stop.name.text);
  context.report("the shortest order is " + joined(names));
  return {StepState::running, "has found the shortest order"};
}

// Routes count the same in both directions.
void Visits::ask_next_length(const WorldView& world, BehaviourContext& context) {
  PlanRequest request;
  request.radius_m = world.robot.radius_m;
  request.seed = seed_;
  if (from_ == 0)
    request.from.pose = world.pose.T_map_robot;
  else
    request.from = place_of(stops_[from_ - 1], world);
  Stop& stop = stops_[to_ - 1];
  request.to = place_of(stop, world);
  const auto is_known = [](const Place& place) { return place.pose || !place.landmarks.empty(); };
  PlanResult route;
  if (is_known(request.from) && is_known(request.to)) route = context.plan(request);
  const bool is_solved = route.outcome == PlanOutcome::solved;
  cost_m_[from_][to_] = cost_m_[to_][from_] = is_solved ? std::min(route.cost_m, kUnreached_m) : kUnreached_m;
  if (!std::isfinite(cost_m_[from_][to_])) cost_m_[from_][to_] = cost_m_[to_][from_] = kUnreached_m;
  // `nearest` is what is nearest from here: the other routes are to the same one.
  if (from_ == 0 && is_solved && !request.to.landmarks.empty() && !route.landmarks.empty())
    stop.chosen = route.landmarks.back();
  if (++to_ > stops_.size()) to_ = ++from_ + 1;
}

bool Visits::resolve(const WorldView& world) {
  const Stop& stop = stops_[next_];
  goal_ = place_of(stop, world);
  if (goal_->pose || !goal_->landmarks.empty()) return true;
  unknown_ = find_place(stop.name, world).unknown;
  goal_.reset();
  return false;
}

Status Visits::drive(const WorldView& world, BehaviourContext& context) {
  if (goal_ && names_retired(*goal_, world.graph)) {
    goal_.reset();
    driver_.restart();
  }
  if (!goal_ && !resolve(world)) return leave_out(unknown_, settings_.skip || if_unknown_ == Unknown::left_out);
  const Status status = driver_.tick(*goal_, world, context);
  const std::string& name = stops_[next_].name.text;
  const std::string number = std::to_string(next_ + 1) + " of " + std::to_string(stops_.size());
  if (status.state == StepState::running)
    return {StepState::running, status.reason + ", to " + name + ", place " + number, status.left_s};
  if (status.state == StepState::failure) {
    if (settings_.skip) context.report("leaves out " + name + ": " + status.reason);
    return leave_out(status.reason, settings_.skip);
  }
  const Landmark* landmark = world.graph.find(driver_.goal_landmark());
  visited_.push_back(landmark == nullptr ? name : described(*landmark));
  context.report("at " + visited_.back() + ", place " + number);
  waiting_since_s_ = world.time_s;
  return wait(world);
}

Status Visits::wait(const WorldView& world) {
  if (world.time_s - *waiting_since_s_ < settings_.wait_s) return {StepState::running, "waiting at " + visited_.back()};
  waiting_since_s_.reset();
  goal_.reset();
  driver_.restart();
  if (++next_ == stops_.size()) return {StepState::success, summary()};
  return {StepState::running, "has been at " + visited_.back()};
}

Status Visits::leave_out(const std::string& why, bool may_be_left_out) {
  const std::string place = stops_[next_].name.text + " (" + why + ")";
  if (!may_be_left_out) return {StepState::failure, "cannot get to " + place + "; " + summary()};
  left_out_.push_back(place);
  goal_.reset();
  driver_.restart();
  if (++next_ < stops_.size()) return {StepState::running, "leaves out " + left_out_.back()};
  return {visited_.empty() ? StepState::failure : StepState::success, summary()};
}

std::string Visits::summary() const {
  std::string text = "visited " + std::to_string(visited_.size()) + " of " + std::to_string(stops_.size()) + " places";
  if (!visited_.empty()) text += ": " + joined(visited_);
  if (!left_out_.empty()) text += "; left out: " + joined(left_out_);
  return text;
}

}  // namespace cairn::behaviours
