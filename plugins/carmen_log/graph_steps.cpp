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
    vertices_.push_back(id_of(line, 1));
    place_of_.emplace(vertices_.back(), vertices_.size() - 1);
    return true;
  }
  if (kind != "EDGE2" && kind != "EDGE_SE2" && kind != "EDGE") return kind == "FIX";
  // Of two edges between the same scans the first stays: closures stand behind the odometry.
  steps_.emplace(std::pair{id_of(line, 1), id_of(line, 2)}, line.pose(3));
  return true;
}

void GraphSteps::add_scan() {
  scans_.push_back(vertices_.empty() ? std::nullopt : std::optional(vertices_.back()));
}

std::vector<GraphSteps::Id> GraphSteps::vertices_of_scans() const {
  const bool are_behind_all = scans_.size() > 1 && scans_.size() == vertices_.size() && scans_.front() == scans_.back();
  if (are_behind_all) return vertices_;
  std::vector<Id> ids;
  for (const std::optional<Id>& vertex : scans_) ids.push_back(vertex.value_or(ids.empty() ? 0 : ids.back() + 1));
  return ids;
}

std::optional<Pose2> GraphSteps::edge(Id from, Id to) const {
  if (const auto at = steps_.find({from, to}); at != steps_.end()) return at->second;
  if (const auto at = steps_.find({to, from}); at != steps_.end()) return inverse(at->second);
  return std::nullopt;
}

std::optional<Pose2> GraphSteps::step(Id from, Id to) const {
  if (from == to) return Pose2{};
  if (const auto direct = edge(from, to)) return direct;
  const auto begin = place_of_.find(from);
  const auto end = place_of_.find(to);
  if (begin == place_of_.end() || end == place_of_.end()) return std::nullopt;
  Pose2 T_from_at;
  for (std::size_t i = begin->second; i < end->second; ++i) {
    const auto next = edge(vertices_[i], vertices_[i + 1]);
    if (!next) return std::nullopt;
    T_from_at = T_from_at * *next;
  }
  return begin->second < end->second ? std::optional(T_from_at) : std::nullopt;
}

GraphSteps::Chain GraphSteps::chained(std::span<const Pose2> T_odom_scan) const {
  const std::vector<Id> vertices = vertices_of_scans();
  Chain chain;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (i == 0) {
      chain.T_first_scan.emplace_back();
      continue;
    }
    const auto known = step(vertices[i - 1], vertices[i]);
    if (!known) ++chain.missing;
    chain.T_first_scan.push_back(chain.T_first_scan.back() *
                                 known.value_or(inverse(T_odom_scan[i - 1]) * T_odom_scan[i]));
  }
  return chain;
}

}  // namespace cairn::carmen_log
