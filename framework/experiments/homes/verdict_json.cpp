#include "framework/experiments/homes/verdict_json.hpp"

#include <nlohmann/json.hpp>

namespace cairn {

std::string json_of(const HomeVerdict& home) {
  nlohmann::ordered_json json = {{"rooms", home.rooms},
                                 {"entered", home.entered},
                                 {"area_m2", home.area_m2},
                                 {"known_ratio", home.known_ratio},
                                 {"contacts", home.contacts},
                                 {"fast_contacts", home.fast_contacts},
                                 {"success", home.said_success},
                                 {"end", home.end},
                                 {"not_entered", home.not_entered}};
  if (home.known_90_s) json["known_90_s"] = *home.known_90_s;
  return json.dump();
}

std::string json_of(const TagVerdict& tags) {
  const nlohmann::ordered_json json = {{"hung", tags.hung},
                                       {"in_sight", tags.in_sight},
                                       {"found", tags.found},
                                       {"found_besides", tags.found_besides},
                                       {"false_landmarks", tags.false_landmarks},
                                       {"sightings", tags.sightings},
                                       {"false_sightings", tags.false_sightings},
                                       {"position_error_m", tags.position_error_m},
                                       {"direction_error_deg", tags.direction_error_deg}};
  return json.dump();
}

}  // namespace cairn
