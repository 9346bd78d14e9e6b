#include "framework/reporting/localisation_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/contracts/localizer.hpp"

namespace cairn {
namespace {

double to_micro(double value) {
  return std::round(value * 1e6) / 1e6;
}

nlohmann::ordered_json place_json(const Pose2& pose) {
  return {{"x_m", to_micro(pose.x_m)}, {"y_m", to_micro(pose.y_m)}, {"angle_deg", to_micro(degrees(pose.theta_rad))}};
}

nlohmann::ordered_json guess_json(const PoseHypothesis& guess) {
  nlohmann::ordered_json row = place_json(guess.T_map_robot);
  row["score"] = to_micro(guess.score);
  row["contradicted_ratio"] = to_micro(guess.contradicted_ratio);
  row["held_by_corners"] = guess.is_held_by_corners;
  return row;
}

nlohmann::ordered_json json_of(const PoseCheck& check) {
  nlohmann::ordered_json looks = nlohmann::ordered_json::array();
  for (const PoseLook& look : check.looks()) {
    looks.push_back({{"driven_m", to_micro(look.driven_m)}, {"believed", guess_json(look.believed)}});
    if (look.elsewhere) looks.back()["elsewhere"] = guess_json(*look.elsewhere);
  }
  return {{"verdict", std::string(name_of(check.verdict()))}, {"looks", std::move(looks)}};
}

}  // namespace

std::string start_check_json(const PoseCheck& check) {
  return json_of(check).dump();
}

std::string doubts_json(const WatchFigures& figures) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const DoubtRecord& doubt : figures.doubts) {
    nlohmann::ordered_json row = {{"begun_s", to_micro(doubt.begun_s)}, {"cause", std::string(name_of(doubt.cause))}};
    row.update(json_of(doubt.check));
    rows.push_back(std::move(row));
  }
  return rows.dump();
}

std::string carried_json(const WatchFigures& figures) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const CarriedRecord& carried : figures.carried) {
    rows.push_back({{"noticed_s", to_micro(carried.noticed_s)},
                    {"distance_m", to_micro(carried.distance_m)},
                    {"driven_m", to_micro(carried.driven_m)}});
    if (!carried.found_s) continue;
    rows.back()["found_s"] = to_micro(*carried.found_s);
    rows.back()["searched_m"] = to_micro(carried.searched_m);
    rows.back()["found_at"] = place_json(carried.T_map_robot);
  }
  return rows.dump();
}

std::string pose_graph_json(const SubmapCounts& counts) {
  const auto& [nodes, submaps, edges, closures, closures_believed] = counts;
  return nlohmann::ordered_json{{"submaps", submaps},
                                {"nodes", nodes},
                                {"edges", edges},
                                {"closures", closures},
                                {"closures_believed", closures_believed}}
      .dump();
}

std::string localisation_json(const LocalisationFigures& figures) {
  const bool is_known = figures.is_pose_given || figures.found_s;
  nlohmann::ordered_json json = {{"trust", std::string(name_of(is_known ? PoseTrust::tracking : PoseTrust::lost))},
                                 {"pose_given", figures.is_pose_given}};
  if (figures.is_pose_given) return json.dump();
  json["searches"] = figures.searches;
  json["driven_m"] = to_micro(figures.driven_m);
  if (figures.found_s) {
    json["found_s"] = to_micro(*figures.found_s);
    json["found_at"] = place_json(figures.T_map_robot);
  }
  json["guesses"] = nlohmann::ordered_json::array();
  for (const PoseHypothesis& guess : figures.guesses) json["guesses"].push_back(guess_json(guess));
  return json.dump();
}

}  // namespace cairn
