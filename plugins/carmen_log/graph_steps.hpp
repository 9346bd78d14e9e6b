// The pose graph in a log: edges from one scan's vertex to the next one's are its odometry.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "plugins/common/logs/log_line.hpp"

namespace cairn::carmen_log {

class GraphSteps {
 public:
  // Whether it is a line of a pose graph. Throws ConfigError when it is a bad one.
  bool read(const log_common::LogLine& line);
  // A scan, of the last vertex; of a log that names no vertices, of the next one.
  void add_scan();

  [[nodiscard]] bool has_steps() const { return !steps_.empty(); }
  // The scans' poses in order, from the first one's.
  [[nodiscard]] std::vector<Pose2> chained() const;
  // Scans without an edge from the one before.
  [[nodiscard]] std::size_t missing() const;

 private:
  using Ids = std::pair<std::int64_t, std::int64_t>;
  [[nodiscard]] std::optional<Pose2> step(std::int64_t from, std::int64_t to) const;

  std::map<Ids, Pose2> steps_;
  std::optional<std::int64_t> vertex_;
  std::vector<std::int64_t> scans_;  // their vertices
};

}  // namespace cairn::carmen_log
