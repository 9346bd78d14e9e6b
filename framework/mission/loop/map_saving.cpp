#include "framework/mission/loop/map_saving.hpp"

#include <cmath>

namespace cairn {
namespace {

bool is_of_a_finished_mission(const std::filesystem::path& map) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(map, error)) return false;
  try {
    const auto progress = MapFile(map).without_cells().progress;
    return progress && progress->step_name.empty();
  } catch (const StoreError&) {
    return false;
  }
}

}  // namespace

MapSaving::MapSaving(const Mission& mission, Options options, Planning& planning, const WorldState& world,
                     Publisher& publisher, std::function<SavedMap(ClusterTree)> content,
                     std::function<KeptSubmaps()> submaps)
    : mission_(mission),
      options_(std::move(options)),
      planning_(planning),
      world_(world),
      publisher_(publisher),
      content_(std::move(content)),
      submaps_(std::move(submaps)),
      leaves_map_alone_(options_.leaves_map_alone),
      autosaver_(options_.folder / autosave_file_of(mission.config),
                 options_.autosaves ? mission.config.autosave.every_s : 0.0, options_.wall_clock,
                 mission.config.clusters.sizes()) {}

void MapSaving::autosave() {
  report_autosave();
  if (leaves_map_alone_ || !autosaver_.is_due()) return;
  const WallClock::Time begin = options_.wall_clock->now();
  autosaver_.save(content_(planning_.last_clusters()), begin);
}

void MapSaving::report_autosave() {
  const auto outcome = autosaver_.last_outcome();
  if (!outcome) return;
  if (outcome->saved)
    publisher_.publish(Autosaved{autosaver_.file().filename().string(), outcome->time_s, outcome->took_ms});
  else if (!autosave_has_failed_)
    publisher_.publish(AutosaveFailed{outcome->reason});
  autosave_has_failed_ = autosave_has_failed_ || !outcome->saved;
}

// Autosaves would write over it, and remove it at the end.
std::string MapSaving::refusal_of(const std::string& file_name) const {
  if (mission_.config.autosave.every_s <= 0.0 || file_name != autosaver_.file().filename()) return {};
  return file_name + " is the name of the mission's autosaves";
}

Status MapSaving::save(const std::string& file_name) {
  if (leaves_map_alone_) return {StepState::success, "not saved: this mission leaves its map alone"};
  Status saved = write(file_name);
  if (saved.state != StepState::success && not_saved_.empty()) not_saved_ = saved.reason;
  return saved;
}

// What an earlier run has finished is not given up for one that was cut short.
void MapSaving::keep_finished_map(const std::string& name, bool is_done) {
  const bool is_earlier = map_file_ != name && !options_.is_resumed;
  if (is_done || !is_earlier || !is_of_a_finished_mission(options_.folder / name)) return;
  if (const auto kept = keep_under_free_name(options_.folder / name))
    publisher_.publish(Message{"this mission did not end: the map of an earlier one that did is kept as " +
                               kept->filename().string()});
}

// The autosave has done its work when a whole map has taken its place.
std::string MapSaving::save_last(bool is_done) {
  if (leaves_map_alone_) {
    autosaver_.finish();
    explored_ratio_ = world_.explored_ratio();
    return {};
  }
  autosaver_.finish();
  report_autosave();
  const AutosaveFigures autosaves = autosaver_.figures();
  const std::string name = mission_.config.mission + ".cairn";
  keep_finished_map(name, is_done);
  const Status saved = write(name);
  if (saved.state != StepState::success) {
    not_saved_ = saved.reason;
    if (autosaves.saved > 0)
      not_saved_ += "; " + autosaver_.file().filename().string() + " holds it up to " +
                    std::to_string(std::lround(autosaves.last_time_s)) + " s";
  } else if (autosaves.saved > 0 && autosaver_.file().filename() != name) {
    std::error_code error;
    std::filesystem::remove(autosaver_.file(), error);
  }
  return not_saved_;
}

Status MapSaving::write(const std::string& file_name) {
  if (world_.grid == nullptr) return {StepState::failure, "there is no map to save"};
  explored_ratio_ = known_ratio(world_.mission_map());
  try {
    SavedMap map = content_(planning_.clusters(world_.mission_map()));
    map.submaps = submaps_();
    if (const std::string fault = fault_of(map.submaps); !fault.empty()) {
      publisher_.publish(Message{"the map is saved without its submaps: " + fault});
      map.submaps = {};
    }
    save_map(options_.folder / file_name, map, Links::replace);
    pose_graph_.reset();
    if (!map.submaps.empty()) pose_graph_ = counts_of(map.submaps);
  } catch (const std::exception& error) {
    return {StepState::failure, std::string("the map could not be saved: ") + error.what()};
  }
  map_file_ = file_name;
  publisher_.publish(MapSaved{file_name});
  return {StepState::success, "saved " + file_name};
}

}  // namespace cairn
