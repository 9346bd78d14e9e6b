// What `cairn plan` is asked, by options or by a line of a query file, and how it is answered for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/contracts/planner.hpp"
#include "framework/planning/plan_task.hpp"
#include "framework/program/common/commands.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

struct PlanQuery {
  nlohmann::json id = "";  // as it came: text or number
  std::string map{};       // of those that are served; empty: the only one
  PlanQuestion question;
};

// One line {"id", "from", "to"} with, optionally, "via", "avoid", "closed", "alternatives", "cost", "explain",
// "trajectory", "map"; what it leaves out is as in `defaults`. Throws ConfigError with file:line:column.
[[nodiscard]] PlanQuery query_of_line(const std::string& line, const std::string& file, int number,
                                      const PlanQuestion& defaults);

// For people; ends with its line feed.
[[nodiscard]] std::string text_of(const PlanQuery& query, const PlanResult& result, const SavedMap& map,
                                  const ClusterTree& clusters);

}  // namespace cairn
