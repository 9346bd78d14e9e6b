// Saves the mission's map: while it runs, when a step asks for it, and at its end.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "framework/contracts/behaviour.hpp"
#include "framework/mission/autosave.hpp"
#include "framework/mission/loop/planning.hpp"
#include "framework/mission/loop/publisher.hpp"

namespace cairn {

class MapSaving {
 public:
  struct Options {
    std::filesystem::path folder;
    bool autosaves = false;   // as the mission's settings say
    bool is_resumed = false;  // what lies in the folder is of this mission
    std::shared_ptr<const WallClock> wall_clock;
    bool leaves_map_alone = false;  // nothing is saved
  };
  // All must outlive it. content: the map as it stands, with these clusters. submaps: what whole maps
  // have in the place of the content's, autosaves not: it takes a while.
  MapSaving(const Mission& mission, Options options, Planning& planning, const WorldState& world, Publisher& publisher,
            std::function<SavedMap(ClusterTree)> content, std::function<KeptSubmaps()> submaps);

  // While it is, nothing is saved.
  void leave_map_alone(bool is_left_alone) { leaves_map_alone_ = is_left_alone; }
  // Once a tick. Changes nothing of what the mission does next.
  void autosave();
  // For a step. Success, or failure with its reason, which save_last() remembers.
  Status save(const std::string& file_name);
  // Why a step cannot save under that name; empty: it can.
  [[nodiscard]] std::string refusal_of(const std::string& file_name) const;
  // The mission has ended, is_done: as it should. Why not everything is saved; empty: it is.
  std::string save_last(bool is_done);

  [[nodiscard]] const std::string& map_file() const { return map_file_; }  // last saved; empty: none
  // In the map as it was last saved; none: it has none.
  [[nodiscard]] const std::optional<SubmapCounts>& pose_graph() const { return pose_graph_; }
  [[nodiscard]] double explored_ratio() const { return explored_ratio_; }  // of the map as it was last saved
  [[nodiscard]] AutosaveFigures figures() const { return autosaver_.figures(); }

 private:
  void report_autosave();
  void keep_finished_map(const std::string& name, bool is_done);
  Status write(const std::string& file_name);

  const Mission& mission_;
  const Options options_;
  Planning& planning_;
  const WorldState& world_;
  Publisher& publisher_;
  const std::function<SavedMap(ClusterTree)> content_;
  const std::function<KeptSubmaps()> submaps_;
  bool leaves_map_alone_;
  Autosaver autosaver_;
  bool autosave_has_failed_ = false;
  std::string map_file_;
  std::optional<SubmapCounts> pose_graph_;
  std::string not_saved_;  // the first reason
  double explored_ratio_ = 0.0;
};

}  // namespace cairn
