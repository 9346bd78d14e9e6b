// Explores until so many landmarks of a category are known, and again from the beginning when all is seen without:
// doors open, people go on, and what has been looked at twice is known better. In between it goes to see whether the
// largest room that it could not get to can be got to now.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/explore.hpp"
#include "plugins/behaviours/route_driver.hpp"

namespace cairn::behaviours {

struct SearchConfig : ExploreConfig {
  ConfigValue category;  // text
  int until = 1;
  int rounds = 5;
  static void describe(Fields<SearchConfig>& fields);
};

class Search : public Behaviour {
 public:
  // categories: that the mission can find, where that is known. Throws ConfigError on another one, with the nearest.
  Search(const SearchConfig& config, std::uint64_t seed, const std::vector<std::string>& categories);
  // Success names the landmarks; failure when all has been explored so many rounds, or time is up, without them.
  Status tick(const WorldView& world, Orders& orders) override;
  void halt() override;

 private:
  void begin_round(const WorldView& world);
  [[nodiscard]] bool is_between_rounds(const WorldView& world, Orders& orders);

  SearchConfig config_;
  std::string category_;
  Explore explore_;
  std::optional<double> begun_s_;
  int round_ = 1;
  std::optional<double> between_since_s_;  // two rounds
  std::optional<Place> room_;              // that it tries to get to then
  std::vector<Point> tried_rooms_;
  RouteDriver driver_;
};

}  // namespace cairn::behaviours
