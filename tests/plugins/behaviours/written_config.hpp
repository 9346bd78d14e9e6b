// Behaviours from the settings that a mission's file gives them.
#pragma once

#include <string>

#include "framework/config/fields.hpp"

namespace cairn::behaviours {

template <class Config>
Config config_of(const std::string& yaml) {
  return load_config<Config>(parse_config_text(yaml, "mission.yaml"), "plugin step");
}

// What is reported about wrong settings.
template <class Make>
std::string error_of(const Make& make) {
  try {
    make();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

inline Landmark landmark_at(const std::string& category, const Pose2& pose, const Pose2& access,
                            const std::string& name = "") {
  Landmark landmark;
  landmark.name = name;
  landmark.category = category;
  landmark.T_map_landmark = pose;
  landmark.access = access;
  return landmark;
}

}  // namespace cairn::behaviours
