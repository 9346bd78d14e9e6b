// How modules register maps of sonar readings.
#pragma once

#include "framework/contracts/module.hpp"

namespace cairn::sonar_model {

// Map(config) gets the robot whose room is free where it stands, and the grid so far when there is one.
template <class Map, class Config>
void add_map(Registrar& registrar, const char* name, const char* summary) {
  registrar.add<Mapper, Config>(name, summary, [](const Config& config, const MapperContext& context) {
    auto map = std::make_unique<Map>(config);
    map->clear_under(context.robot);
    if (context.grid_so_far != nullptr) map->begin_with(*context.grid_so_far);
    return map;
  });
}

}  // namespace cairn::sonar_model
