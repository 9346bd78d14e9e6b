// Ids as files number their nodes and edges, and the ids that these get in a landmark graph.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "maps/base/source_text.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn::exchange {

inline constexpr std::int64_t kMaxFileId = (std::int64_t{1} << 53) - 1;

struct FileId {
  std::int64_t id = 0;
  std::size_t offset = 0;  // where it stands
};

// Nodes keep their ids, but for 0: it gets the next free one.
class NodeIds {
 public:
  // Throws ExchangeError at an id that an earlier node has.
  NodeIds(std::vector<FileId> nodes, const SourceText& source);

  // 0 when there is no such node.
  [[nodiscard]] LandmarkId landmark_of(std::int64_t id) const;
  // A sentence on node 0, when there is one; `more` behind it.
  void warn_of_zero(std::vector<std::string>& warnings, const std::string& more = "") const;

 private:
  std::vector<std::int64_t> sorted_;
  LandmarkId zero_ = 0;
};

// Edges keep their ids, but for 0 and what an earlier edge has: these get the next free ones, in the order of the file.
class EdgeIds {
 public:
  explicit EdgeIds(const std::vector<std::int64_t>& ids);
  [[nodiscard]] RouteId route_of(std::size_t edge) const { return routes_[edge]; }
  [[nodiscard]] std::size_t renumbered() const { return renumbered_; }

 private:
  std::vector<RouteId> routes_;
  std::size_t renumbered_ = 0;
};

// The numbers of ids like "n17", when all ids are the same letters (or none) and a number.
[[nodiscard]] std::optional<std::vector<std::int64_t>> numbers_of(const std::vector<std::string_view>& ids);

// A sentence on names that more than one landmark has.
void warn_of_shared_names(const LandmarkGraph& graph, std::vector<std::string>& warnings);

}  // namespace cairn::exchange
