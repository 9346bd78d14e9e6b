// Saves the map of a running mission every so often, beside the mission: the loop hands over a copy, a thread of
// its own compresses it and writes what has changed.
//
// What is in an autosave never changes what the mission does. Intervals are wall clock: what a crash costs is what
// somebody has waited for.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "framework/config/fields.hpp"
#include "framework/modules/wall_clock.hpp"
#include "maps/clustering/clustering.hpp"
#include "maps/store/map_updater.hpp"

namespace cairn {

struct AutosaveConfig {
  double every_s = 30.0;
  std::string file;
  static void describe(Fields<AutosaveConfig>& fields);
};

struct AutosaveFigures {
  int saved = 0;
  int failed = 0;
  std::string failure{};     // the first; empty when none
  double last_time_s = 0.0;  // mission time that the last one saved holds
  double in_loop_s = 0.0;    // wall clock that the mission has waited for its copies
  double writing_s = 0.0;    // wall clock of the thread that writes
  std::uint64_t written_bytes = 0;
};

class Autosaver {
 public:
  // every_s 0: never due. Starts no thread before the first copy comes. sizes: of the copies' clusters.
  Autosaver(std::filesystem::path file, double every_s, std::shared_ptr<const WallClock> wall_clock,
            const ClusterSizes& sizes = {});
  Autosaver(const Autosaver&) = delete;
  Autosaver& operator=(const Autosaver&) = delete;
  ~Autosaver();  // waits as finish() does

  // To be asked after every tick. Due so early that the copy should be on the disk when the interval since the last one
  // is over, as long as ticks and writing have taken so far; at the earliest after half of it, and when the last copy
  // is written.
  [[nodiscard]] bool is_due();
  // taken: when the copy was begun. Its clusters may be those of an earlier state: they are brought in line here.
  void save(SavedMap copy, WallClock::Time taken);
  // Waits until nothing is being written; what was beside the file is gone. Nothing may be saved afterwards.
  void finish();

  struct Outcome {
    bool saved = false;
    double time_s = 0.0;   // of the mission, in the copy
    double took_ms = 0.0;  // from taking the copy to the file on the disk
    std::string reason{};  // why not
  };
  // What has come of the last copy, once.
  [[nodiscard]] std::optional<Outcome> last_outcome();
  [[nodiscard]] AutosaveFigures figures() const;
  [[nodiscard]] const std::filesystem::path& file() const { return updater_.file(); }

 private:
  void write_copies();
  void write(SavedMap& copy);
  void note(Outcome outcome);
  [[nodiscard]] double seconds_since(WallClock::Time begin) const;

  const std::chrono::duration<double> every_;
  const std::shared_ptr<const WallClock> wall_clock_;
  // Of the mission's thread only.
  std::optional<WallClock::Time> last_;   // when the last copy was taken
  std::optional<WallClock::Time> asked_;  // when it was last asked whether one is due
  std::chrono::duration<double> longest_tick_{0.0};

  const ClusterSizes sizes_;
  MapUpdater updater_;  // of the thread that writes only

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<SavedMap> copy_;  // to be written
  WallClock::Time taken_;
  bool writing_ = false;
  bool ending_ = false;
  std::chrono::duration<double> longest_write_{0.0};  // from taking a copy to the file on the disk
  std::optional<Outcome> outcome_;
  AutosaveFigures figures_;
  std::thread thread_;
};

struct KeptAutosave {
  std::filesystem::path file;
  int removed = 0;  // that held less
};
// An autosave that an earlier run has left in the folder is the only thing that it has left. Of it and of those that
// were kept before, the one whose mission had come furthest gets the name "office.autosave.1.cairn"; the others are
// removed, so that there are two with this run's. resumed: the map that this run goes on from stays as it is. Nothing
// when the last run has left none, or it cannot be moved.
[[nodiscard]] std::optional<KeptAutosave> keep_earlier_autosave(const std::filesystem::path& file,
                                                                const std::filesystem::path& resumed = {});
// Gives the file a free name ("office.1.cairn") and returns that. Nothing when it cannot be moved.
[[nodiscard]] std::optional<std::filesystem::path> keep_under_free_name(const std::filesystem::path& file);

}  // namespace cairn
