// Explores until so many landmarks of a category are known. When all in reach is seen without, it tries to get to what
// was out of reach, the largest room first, and explores on there; and begins again when there is no such room left:
// doors open, people leave, and what has been looked at twice is known better.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/exploring/explore.hpp"
#include "plugins/behaviours/places/map_watch.hpp"
#include "plugins/behaviours/places/place_name.hpp"

namespace cairn::behaviours {

// Between two rounds of a search.
struct SearchRoundSettings {
  double pause_s = 10.0;
  double to_room_at_most_s = 90.0;
  double been_apart_m = 0.5;
  static void describe(Fields<SearchRoundSettings>& fields);
};

struct SearchConfig : ExploreConfig {
  ConfigValue category;  // text
  ConfigValue at;        // place
  int until = 1;
  int rounds = 3;
  std::string output;  // the name of the place that it gives
  SearchRoundSettings between_rounds;
  static void describe(Fields<SearchConfig>& fields);
};

class Search : public Behaviour {
 public:
  // categories: that the mission can find, where that is known. Throws ConfigError on another one, with the nearest.
  Search(const SearchConfig& config, std::uint64_t seed, const std::vector<std::string>& categories);
  // Success names the landmarks and gives them to later steps as one place; failure when all has been explored so many
  // rounds, or time is up, without them.
  Status tick(const WorldView& world, BehaviourContext& context) override;
  void halt() override;

 private:
  void begin_in_new_map(const MapMove* move);
  [[nodiscard]] std::string in_round() const;
  [[nodiscard]] std::optional<Status> go_to_begin(const WorldView& world, BehaviourContext& context);
  [[nodiscard]] std::optional<Status> between(const WorldView& world, BehaviourContext& context);
  Status nothing_left(const std::string& found, const std::string& why, const WorldView& world,
                      BehaviourContext& context);

  SearchConfig config_;
  std::string category_;
  std::optional<PlaceName> begin_at_;
  std::optional<Place> begin_;  // what that is
  bool has_begun_there_ = false;
  Explore explore_;
  std::optional<double> begun_s_;
  int round_ = 1;
  std::optional<double> waits_since_s_;  // between two rounds
  std::optional<Place> room_;            // that it tries to get to
  double to_room_since_s_ = 0.0;
  std::vector<Point> been_at_;  // and what it could not get to, of this round
  RouteDriver driver_;
  MapWatch map_watch_;
};

}  // namespace cairn::behaviours
