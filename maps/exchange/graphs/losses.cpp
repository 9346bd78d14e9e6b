#include "maps/exchange/graphs/losses.hpp"

#include <algorithm>
#include <functional>

#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"

namespace cairn::exchange {
namespace {

class Warnings {
 public:
  explicit Warnings(const LandmarkGraph& graph) : graph_(graph) {}

  template <class IsLost>
  void of_landmarks(bool holds, const char* what, IsLost is_lost) {
    if (holds) return;
    report(std::ranges::count_if(graph_.landmarks(), [&](const auto& entry) { return is_lost(entry.second); }),
           "landmark", what);
  }
  template <class IsLost>
  void of_routes(bool holds, const char* what, IsLost is_lost) {
    if (holds) return;
    report(std::ranges::count_if(graph_.routes(), [&](const auto& entry) { return is_lost(entry.second); }), "route",
           what);
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(warnings_); }

 private:
  void report(std::ptrdiff_t count, const char* noun, const char* what) {
    warn_of(static_cast<std::size_t>(count), noun, what, warnings_);
  }

  const LandmarkGraph& graph_;
  std::vector<std::string> warnings_;
};

bool routes_are_numbered_in_order(const LandmarkGraph& graph) {
  RouteId expected = 1;
  return std::ranges::all_of(graph.routes(), [&](const auto& entry) { return entry.first == expected++; });
}

}  // namespace

std::vector<std::string> warnings_of_loss(const LandmarkGraph& graph, const Holds& format) {
  Warnings warnings(graph);
  warnings.of_landmarks(format.category, "the category is not written", [](auto& l) { return !l.category.empty(); });
  warnings.of_landmarks(format.heading, "the heading is not written",
                        [](auto& l) { return l.T_map_landmark.theta_rad != 0.0; });
  warnings.of_landmarks(format.access, "where a robot stands at it is not written",
                        [](auto& l) { return l.access.has_value(); });
  warnings.of_landmarks(format.level, "the floor is not written", [](auto& l) { return l.level != 0; });
  warnings.of_landmarks(format.annotations, "what other tools keep with it is not written",
                        [](auto& l) { return !l.annotations.empty(); });
  warnings.of_landmarks(format.marker, "which printed marker it is is not written",
                        [](auto& l) { return l.marker.has_value(); });
  warnings.of_landmarks(false, "how it was recognised is not written", [](auto& l) {
    return l.sightings != 0 || l.degree != 0.0 || !l.templates.empty() || !l.evidence.empty();
  });
  warnings.of_routes(format.closed, "closed, and so left out: whoever reads the file would drive there",
                     [](auto& r) { return r.closed; });
  warnings.of_routes(format.level, "the floor is not written", [](auto& r) { return r.level != 0; });
  warnings.of_routes(format.trajectory, "the trajectory is not written", [](auto& r) { return !r.trajectory.empty(); });
  warnings.of_routes(format.driven, "that a robot has driven it is not written", [](auto& r) { return r.driven; });
  warnings.of_routes(format.speed_limit, "the speed limit is not written",
                     [](auto& r) { return r.speed_limit_mps.has_value(); });
  warnings.of_routes(format.annotations, "what other tools keep with it is not written",
                     [](auto& r) { return !r.annotations.empty(); });
  std::vector<std::string> reported = warnings.take();
  if (!format.route_ids && !routes_are_numbered_in_order(graph))
    reported.emplace_back("routes are numbered anew, from 1 in their order");
  if (!graph.retired().empty())
    reported.push_back(counted(graph.retired().size(), "retired landmark") + ": not written");
  return reported;
}

}  // namespace cairn::exchange
