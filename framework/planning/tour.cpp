#include "framework/planning/tour.hpp"

#include <algorithm>
#include <string>

namespace cairn {
namespace {

template <class Values>
void append(Values& values, const Values& more) {
  values.insert(values.end(), more.begin(), more.end());
}

// The same landmark or pose ends one leg and begins the next.
template <class Values>
void append_joined(Values& values, const Values& more) {
  const bool same = !values.empty() && !more.empty() && values.back() == more.front();
  values.insert(values.end(), more.begin() + (same ? 1 : 0), more.end());
}

std::optional<double> sum_of(std::optional<double> a, std::optional<double> b) {
  return a && b ? std::optional(*a + *b) : std::nullopt;
}

std::optional<double> cost_with_all_open(const RouteExplanation& leg) {
  return leg.cost_with_closed_open ? leg.cost_with_closed_open : leg.cost;
}

void append_explanation(std::optional<RouteExplanation>& sum, const std::optional<RouteExplanation>& leg) {
  if (!leg) return;
  if (!sum) {
    sum = leg;
    return;
  }
  sum->search_level = std::max(sum->search_level, leg->search_level);
  sum->settled_of_level.resize(std::max(sum->settled_of_level.size(), leg->settled_of_level.size()));
  for (std::size_t l = 0; l < leg->settled_of_level.size(); ++l) sum->settled_of_level[l] += leg->settled_of_level[l];
  sum->clusters.resize(std::max(sum->clusters.size(), leg->clusters.size()));
  for (std::size_t l = 0; l < leg->clusters.size(); ++l) append_joined(sum->clusters[l], leg->clusters[l]);
  const auto all_open = sum_of(cost_with_all_open(*sum), cost_with_all_open(*leg));
  const bool better = all_open && (sum->cost_with_closed_open || leg->cost_with_closed_open);
  sum->cost_with_closed_open = better ? all_open : std::nullopt;
  append(sum->closed_on_cheaper_path, leg->closed_on_cheaper_path);
  if (!better) sum->closed_on_cheaper_path.clear();
  sum->cost = sum_of(sum->cost, leg->cost);
}

void append_leg(PlanResult& tour, const PlanResult& leg) {
  tour.outcome = leg.outcome;
  tour.cost_m += leg.cost_m;
  tour.length_m += leg.length_m;
  append_joined(tour.landmarks, leg.landmarks);
  append(tour.routes, leg.routes);
  append(tour.blocked_routes, leg.blocked_routes);
  append_joined(tour.path, leg.path);
  append(tour.segments, leg.segments);
  tour.settled += leg.settled;
  tour.time_ms.graph_ms += leg.time_ms.graph_ms;
  tour.time_ms.route_ms += leg.time_ms.route_ms;
  tour.time_ms.total_ms += leg.time_ms.total_ms;
  append_explanation(tour.explanation, leg.explanation);
  tour.driving_time_s = sum_of(tour.driving_time_s, leg.driving_time_s);
}

// Where the next leg begins.
Place arrived_at(const Place& wanted, const PlanResult& leg) {
  if (wanted.landmarks.empty() || leg.landmarks.empty()) return wanted;
  Place place;
  place.landmarks = {leg.landmarks.back()};
  return place;
}

}  // namespace

PlanResult plan_tour(const PlanCall& plan, PlanRequest request, std::span<const Place> via) {
  if (via.empty()) return plan(request);
  request.alternatives = 0;
  std::vector<Place> stops(via.begin(), via.end());
  stops.push_back(request.to);
  // Where a stop is any one of several, the least of each leg says nothing of the whole.
  const bool adds_up = std::ranges::all_of(via, [](const Place& stop) { return stop.landmarks.size() <= 1; });
  PlanResult tour;
  if (adds_up) tour.length_lower_bound_m = 0.0;
  tour.driving_time_s = 0.0;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    request.to = stops[i];
    const PlanResult leg = plan(request);
    tour.margin_m = i == 0 ? leg.margin_m : std::min(tour.margin_m, leg.margin_m);
    tour.clearance_m = i == 0 ? leg.clearance_m : std::min(tour.clearance_m, leg.clearance_m);
    append_leg(tour, leg);
    tour.length_lower_bound_m = sum_of(tour.length_lower_bound_m, leg.length_lower_bound_m);
    const std::string number = std::to_string(i + 1) + " of " + std::to_string(stops.size());
    tour.reason += (i == 0 ? "leg " : "; leg ") + number + ": " + leg.reason;
    if (leg.outcome != PlanOutcome::solved) {
      tour.reason = "leg " + number + ": " + leg.reason;
      tour.length_lower_bound_m.reset();
      tour.driving_time_s.reset();
      return tour;
    }
    request.from = arrived_at(stops[i], leg);
  }
  return tour;
}

}  // namespace cairn
