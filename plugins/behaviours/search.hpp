// Explores until so many landmarks of a category are known.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/explore.hpp"

namespace cairn::behaviours {

struct SearchConfig : ExploreConfig {
  ConfigValue category;  // text
  int until = 1;
  static void describe(Fields<SearchConfig>& fields);
};

class Search : public Behaviour {
 public:
  // categories: that the mission can find, where that is known. Throws ConfigError on another one, with the nearest.
  Search(const SearchConfig& config, const std::vector<std::string>& categories);
  // Success names the landmarks; failure when all is explored, or time is up, without them.
  Status tick(const WorldView& world, Orders& orders) override;
  void halt() override;

 private:
  SearchConfig config_;
  std::string category_;
  Explore explore_;
};

}  // namespace cairn::behaviours
