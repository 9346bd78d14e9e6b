#include "plugins/carmen_log/graph_steps.hpp"

#include <cmath>
#include <string>

#include "framework/config/config_value.hpp"

namespace cairn::carmen_log {
namespace {

constexpr double kMaxId = 1e15;

std::int64_t id_of(const log_common::LogLine& line, std::size_t i) {
  const double id = line.finite(i, "vertex");
  if (id < 0.0 || id > kMaxId || std::floor(id) != id)
    throw ConfigError(line.place(i), "a vertex is a whole number from 0 on, not " + std::string(line.word(i)));
  return static_cast<std::int64_t>(id);
}

}  // namespace

bool GraphSteps::read(const log_common::LogLine& line) {
  const std::string_view kind = line.word(0);
  if (kind == "VERTEX2" || kind == "VERTEX_SE2" || kind == "VERTEX") {
    vertex_ = id_of(line, 1);
    return true;
  }
  if (kind != "EDGE2" && kind != "EDGE_SE2" && kind != "EDGE") return kind == "FIX";
  // Of two edges between the same scans the first stays: closures stand behind the odometry.
  steps_.emplace(Ids{id_of(line, 1), id_of(line, 2)}, line.pose(3));
  return true;
}

void GraphSteps::add_scan() {
  if (vertex_)
    scans_.push_back(*vertex_);
  else
    scans_.push_back(scans_.empty() ? 0 : scans_.back() + 1);
}

std::optional<Pose2> GraphSteps::step(std::int64_t from, std::int64_t to) const {
  if (from == to) return Pose2{};
  if (const auto at = steps_.find({from, to}); at != steps_.end()) return at->second;
  if (const auto at = steps_.find({to, from}); at != steps_.end()) return inverse(at->second);
  return std::nullopt;
}

std::vector<Pose2> GraphSteps::chained() const {
  std::vector<Pose2> T_first_scan;
  for (std::size_t i = 0; i < scans_.size(); ++i)
    T_first_scan.push_back(i == 0 ? Pose2{} : T_first_scan.back() * step(scans_[i - 1], scans_[i]).value_or(Pose2{}));
  return T_first_scan;
}

std::size_t GraphSteps::missing() const {
  std::size_t missing = 0;
  for (std::size_t i = 1; i < scans_.size(); ++i)
    if (!step(scans_[i - 1], scans_[i])) ++missing;
  return missing;
}

}  // namespace cairn::carmen_log
