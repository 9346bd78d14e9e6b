// The pose graph in a log: edges from one scan's vertex to the next one's are its odometry.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
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
  struct Chain {
    std::vector<Pose2> T_first_scan;
    std::size_t missing = 0;  // steps without edges
  };
  // The scans' poses in order, from the first one's. Where no edges lead from a scan to the next one, the step between
  // the other poses is taken, of which there is one a scan.
  [[nodiscard]] Chain chained(std::span<const Pose2> T_odom_scan) const;

 private:
  using Id = std::int64_t;
  // By one edge.
  [[nodiscard]] std::optional<Pose2> edge(Id from, Id to) const;
  // Also over the vertices that the log names between the two, which may have no scans.
  [[nodiscard]] std::optional<Pose2> step(Id from, Id to) const;
  [[nodiscard]] std::vector<Id> vertices_of_scans() const;

  std::map<std::pair<Id, Id>, Pose2> steps_;
  std::vector<Id> vertices_;              // in the order of the log
  std::map<Id, std::size_t> place_of_;    // in vertices_
  std::vector<std::optional<Id>> scans_;  // their vertices
};

}  // namespace cairn::carmen_log
