#include <algorithm>
#include <array>

#include "tests/fuzz/reader.hpp"

namespace cairn::fuzz {
namespace {

constexpr std::array kReaders{
    Reader{"annotations", read_annotations},
    Reader{"carmen_log", read_carmen_log},
    Reader{"damaged_map", read_damaged_map},
    Reader{"experiment", read_experiment},
    Reader{"graph_list", read_graph_list},
    Reader{"graphml", read_graphml},
    Reader{"json_log", read_json_log},
    Reader{"laser_log", read_laser_log},
    Reader{"lego_log", read_lego_log},
    Reader{"map_server", read_map_server},
    Reader{"mcap_log", read_mcap_log},
    Reader{"mission", read_mission},
    Reader{"moving_ai_map", read_moving_ai_map},
    Reader{"moving_ai_scen", read_moving_ai_scen},
    Reader{"nav2_routes", read_nav2_routes},
    Reader{"patrolling_graph", read_patrolling_graph},
    Reader{"picture", read_picture},
    Reader{"place", read_place},
    Reader{"plan_queries", read_plan_queries},
    Reader{"player_log", read_player_log},
    Reader{"rmf", read_rmf},
    Reader{"robot", read_robot},
    Reader{"saved_map", read_saved_map},
    Reader{"table_log", read_table_log},
    Reader{"template", read_template},
    Reader{"tntp", read_tntp},
    Reader{"world", read_world},
    Reader{"yaml", read_yaml},
};

}  // namespace

std::span<const Reader> readers() {
  return kReaders;
}

const Reader& reader_called(std::string_view name) {
  const auto found = std::ranges::find(kReaders, name, &Reader::name);
  if (found == kReaders.end()) throw std::invalid_argument("no reader is called " + std::string(name));
  return *found;
}

}  // namespace cairn::fuzz
