#include "framework/planning/margins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

namespace cairn {
namespace {

// Another margin changes nothing.
bool is_final(PlanOutcome outcome) {
  return is_refusal(outcome) || outcome == PlanOutcome::out_of_budget;
}

// No path with less of a margin can be much shorter.
bool is_nearly_straight(const PlanResult& result) {
  if (result.path.empty()) return true;
  const double straight_m = (result.path.back().position() - result.path.front().position()).norm();
  return result.length_m <= kMaxMarginDetour * straight_m;
}

// Asks a planner with one margin after the other.
class Margins {
 public:
  Margins(const PlanCall& plan, const PlanRequest& request, std::span<const double> margins_m)
      : plan_(plan), request_(request), margins_m_(margins_m) {}

  PlanResult answer() {
    for (const double margin_m : margins_m_.first(margins_m_.size() - 1)) {
      PlanResult result = ask(margin_m);
      if (is_final(result.outcome)) return timed(std::move(result));
      const std::string why_not = refusal_of(result);
      if (why_not.empty()) return with_reason(std::move(result));
      if (why_relaxed_.empty()) why_relaxed_ = why_not;
    }
    return with_reason(PlanResult(last()));
  }

 private:
  PlanResult ask(double margin_m) {
    PlanRequest asked = request_;
    asked.radius_m = request_.radius_m + margin_m;
    PlanResult result = plan_(asked);
    result.margin_m = margin_m;
    if (result.outcome == PlanOutcome::solved) result.clearance_m += margin_m;
    spent_.graph_ms += result.time_ms.graph_ms;
    spent_.route_ms += result.time_ms.route_ms;
    spent_.total_ms += result.time_ms.total_ms;
    return result;
  }

  const PlanResult& last() {
    if (!last_) last_ = ask(margins_m_.back());
    return *last_;
  }

  // Why a smaller margin is asked for; empty: the result is good.
  std::string refusal_of(const PlanResult& result) {
    if (result.outcome != PlanOutcome::solved) return "there is no path";
    if (result.blocked_routes.empty() && is_nearly_straight(result)) return "";
    if (last().outcome != PlanOutcome::solved) return "";
    for (const RouteId route : result.blocked_routes)
      if (std::ranges::find(last().blocked_routes, route) == last().blocked_routes.end())
        return fmt::format("route R{} is too narrow", route);
    if (result.length_m > kMaxMarginDetour * last().length_m)
      return fmt::format("the path is {:.2f} m long", result.length_m);
    return "";
  }

  PlanResult timed(PlanResult result) const {
    result.time_ms = spent_;
    return result;
  }

  PlanResult with_reason(PlanResult result) const {
    if (result.outcome == PlanOutcome::solved && !why_relaxed_.empty())
      result.reason += fmt::format("{}with a margin of {:g} m beside the robot {}, so it keeps {}",
                                   result.reason.empty() ? "" : "; ", margins_m_.front(), why_relaxed_,
                                   result.margin_m > 0.0 ? fmt::format("{:g} m", result.margin_m) : "none");
    return timed(std::move(result));
  }

  const PlanCall& plan_;
  const PlanRequest& request_;
  std::span<const double> margins_m_;
  std::optional<PlanResult> last_;
  std::string why_relaxed_;
  PlanTimes spent_;
};

}  // namespace

std::vector<double> usual_margins_m(const RobotModel& robot, const OccupancyGrid& grid) {
  const bool is_disc = robot.polygon_m.empty() && robot.kinematics == Kinematics::differential;
  if (!is_disc || grid.bounds().empty()) return {0.0};
  return {kMargins_m.begin(), kMargins_m.end()};
}

PlanResult plan_with_margins(const PlanCall& plan, const PlanRequest& request, std::span<const double> margins_m) {
  return Margins(plan, request, margins_m).answer();
}

}  // namespace cairn
