// What a planner over a saved map is made of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cairn {

inline constexpr double kMaxRadius_m = 10.0;  // of a robot that a plan is for

struct MapPlannerOptions {
  std::filesystem::path map;
  std::string planner = "hybrid";
  std::vector<std::string> settings;  // of the planner, key=value
  std::filesystem::path robot;        // a robot file
  std::optional<double> radius_m;
  std::optional<double> margin_m;  // none: the usual margins for a robot, none for a radius that is given
  std::optional<double> budget_ms;
  std::int64_t seed = 1;
};

// How it will be asked.
enum class PlannerUse {
  one_question,             // a large grid is read as far as the answer needs it
  one_question_whole_grid,  // the grid is wanted whole, as for a picture
  many_in_turn,             // by one thread; a large grid may be read as far as the answers need it
  many_at_once,             // by several threads
};

}  // namespace cairn
