// Goes to several places, one after the other: what touring and patrolling share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/places/place_name.hpp"

namespace cairn::behaviours {

inline constexpr std::size_t kMaxPlaces = 50;

enum class VisitOrder { given, shortest };

struct VisitSettings : RouteSettings {
  ConfigValue places;  // a list
  VisitOrder order = VisitOrder::given;
  bool skip = false;
  double wait_s = 0.0;

  template <class Config>
  static void describe_visits(Fields<Config>& fields) {
    fields.choice(
        "order", static_cast<VisitOrder Config::*>(&Config::order),
        {{"given", VisitOrder::given}, {"shortest", VisitOrder::shortest}},
        "`shortest`: so that the whole route is short, by the planner's lengths: the best order up to 11 places, "
        "cheapest insertion and 2-opt for more");
    fields.flag("skip", &Config::skip, "a place that cannot be reached is left out; without it, the step fails there");
    fields.number("wait_s", &Config::wait_s, {0.0, 1e6}, "s", "stands still at each place");
    fields.number("tolerance_m", &Config::tolerance_m, {0.01, 2.0}, "m", "this near to the end of a plan is there");
    fields.number("speed_mps", &Config::speed_mps, {0.01, 5.0}, "m/s", "top speed, within the robot's own limits");
    fields.number("patience_s", &Config::patience_s, {0.1, 3600.0}, "s",
                  "how long it waits for a blockage to go before it tries anything else");
    describe_driving(fields);
  }
};

// Throws ConfigError unless it is a list of 1 to kMaxPlaces places.
[[nodiscard]] std::vector<PlaceName> to_place_names(const ConfigValue& value, const std::string& key);

// Of a place that is unknown when it is its turn: as `skip` says, or left out because nobody has asked for just that.
enum class Unknown { as_skip_says, left_out };

class Visits {
 public:
  Visits(const VisitSettings& settings, std::uint64_t seed, std::vector<PlaceName> places,
         Unknown unknown = Unknown::as_skip_says);

  // Success when every place was visited or left out, but not all left out; failure with the place and why. `shortest`
  // asks the planner for one route a tick, n (n + 1) / 2 in all, while the robot stands.
  Status tick(const WorldView& world, BehaviourContext& context);

  [[nodiscard]] std::size_t visited() const { return visited_.size(); }
  [[nodiscard]] std::size_t left_out() const { return left_out_.size(); }
  // "visited 2 of 3 places: L1 (square), (1.50, 2.00); left out: L4 (no_route: ...)".
  [[nodiscard]] std::string summary() const;

 private:
  struct Stop {
    PlaceName name;
    std::optional<LandmarkId> chosen;  // of several landmarks, when the order was found
  };
  Status find_order(const WorldView& world, BehaviourContext& context);
  void ask_next_length(const WorldView& world, BehaviourContext& context);
  Status drive(const WorldView& world, BehaviourContext& context);
  Status wait(const WorldView& world);
  Status leave_out(const std::string& why, bool may_be_left_out);
  [[nodiscard]] bool resolve(const WorldView& world);
  [[nodiscard]] Place place_of(const Stop& stop, const WorldView& world) const;

  VisitSettings settings_;
  std::uint64_t seed_;
  RouteDriver driver_;
  std::vector<Stop> stops_;  // in the order of the visits, once that is known
  std::size_t next_ = 0;
  std::optional<Place> goal_;
  Unknown if_unknown_;
  std::string unknown_;  // why there is no goal
  std::optional<double> waiting_since_s_;
  std::vector<std::string> visited_;
  std::vector<std::string> left_out_;

  bool ordered_ = false;
  std::vector<std::vector<double>> cost_m_;  // [0] from where the robot stands
  std::size_t from_ = 0;                     // the route that is asked for next
  std::size_t to_ = 1;
};

}  // namespace cairn::behaviours
