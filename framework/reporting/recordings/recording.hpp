// The observations of a run as a CARMEN log that gives them back to the last bit (docs/logs.md).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "framework/mission/events.hpp"
#include "maps/base/output_file.hpp"

namespace cairn {

class RunRecording : public Listener {
 public:
  // A file whose name ends in .gz is packed by gzip. Throws std::runtime_error when the file cannot be written.
  RunRecording(const std::filesystem::path& file, const Pose2& T_map_start);

  // Writes one observation a tick. What a killed program leaves lacks at most the last five seconds, and can be read.
  // Throws std::runtime_error when the disk takes no more.
  void on(const Event& event, const MissionView& view) override;
  // The last bytes go to the disk. Throws like on().
  void close();

 private:
  void write(const Observation& observation, const std::optional<GroundTruth>& truth);
  void write_new_sensors(const Observation& observation, std::string_view end);
  [[nodiscard]] int number_of(const RangeReading& reading, std::string_view end);
  void write_ranges(const Observation& observation, std::string_view end);
  void write_sonars(std::span<const RangeReading> ranges, std::string_view end);
  void write_scan(std::span<const RangeReading> rays, const Pose2& T_odom_robot, std::string_view end);
  void write_text();

  std::string file_name_;
  bool is_packed_;
  GrowingFile out_;
  std::string text_;                              // not yet written
  double written_s_ = -1e9;                       // stamp of the last observation in the file
  std::unordered_map<std::string, int> numbers_;  // of transducers, by their values as text
  // The same of each sensor as it was last: a laser's beams come again and again.
  std::unordered_map<int, std::pair<RangeReading, int>> last_numbers_;
  std::vector<int> fired_;  // in this observation, by number
};

}  // namespace cairn
