// What `cairn plan` is asked, by options or by a line of a query file, and how it is answered in JSON and for people.
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/contracts/planner.hpp"
#include "framework/program/commands.hpp"
#include "maps/map_store.hpp"

namespace cairn {

struct PlanQuery {
  nlohmann::json id = "";  // as it came: text or number
  PlanQuestion question;
};

// One line {"id", "from", "to"} with, optionally, "via", "avoid", "closed", "alternatives", "cost", "explain",
// "trajectory"; what it leaves out is as in `defaults`. Throws ConfigError with file:line:column.
[[nodiscard]] PlanQuery query_of_line(const std::string& line, const std::string& file, int number,
                                      const PlanQuestion& defaults);

// Throws std::invalid_argument, with a sentence, on a question that no map could answer.
void check(const PlanQuestion& question);

// The request that a question makes on a map; `via` gets its stops. Throws PlaceError.
struct PlanTask {
  PlanRequest request;
  std::vector<Place> via;
};
[[nodiscard]] PlanTask task_of(const PlanQuestion& question, const SavedMap& map, const ClusterTree& clusters);

[[nodiscard]] nlohmann::ordered_json json_of(const PlanQuery& query, const PlanResult& result, const SavedMap& map,
                                             const ClusterTree& clusters);
void tell_people(std::ostream& out, const PlanQuery& query, const PlanResult& result, const SavedMap& map,
                 const ClusterTree& clusters);

}  // namespace cairn
