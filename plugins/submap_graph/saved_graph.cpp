#include "plugins/submap_graph/saved_graph.hpp"

#include <algorithm>

#include "maps/submaps/covered_submaps.hpp"

namespace cairn::submap_graph {
namespace {

// Finer than what scans are searched in: a later run aligns its scans with these echoes.
constexpr double kSavedCell_m = 0.05;

// A run's nodes are numbered on from the earlier ones, behind a gap: its first ones are none of the submap that the
// last run was in (nodes_of()).
class Numbers {
 public:
  explicit Numbers(const KeptSubmaps& earlier)
      : earlier_(earlier), next_(earlier.empty() ? 0 : earlier.nodes.back().number + 2) {}
  [[nodiscard]] std::int64_t of(std::size_t node) const {
    const std::size_t held = earlier_.nodes.size();
    return node < held ? earlier_.nodes[node].number : next_ + static_cast<std::int64_t>(node - held);
  }

 private:
  const KeptSubmaps& earlier_;
  std::int64_t next_;
};

void add_edges(const TiedGraph& graph, const Numbers& numbers, std::vector<KeptEdge>& edges) {
  edges.reserve(edges.size() + graph.ties().size() + graph.closures().size());
  for (const PoseEdge& tie : graph.ties())
    edges.push_back({numbers.of(tie.from), numbers.of(tie.to), tie.T_from_to, tie.information, false, true});
  for (std::size_t i = 0; i < graph.closures().size(); ++i) {
    const Closure& closure = graph.closures()[i];
    edges.push_back({numbers.of(closure.anchor), numbers.of(closure.node), closure.T_anchor_node, closure.information,
                     true, graph.is_believed()[i]});
  }
}

void add_submaps(const LaserGraph& laser_graph, std::size_t known_nodes, const Numbers& numbers,
                 std::vector<KeptSubmap>& kept) {
  const auto& submaps = laser_graph.local_map().submaps();
  kept.reserve(kept.size() + submaps.size());
  for (std::size_t i = 0; i < submaps.size() && submaps[i]->anchor() < known_nodes; ++i) {
    KeptSubmap submap{.anchor = numbers.of(submaps[i]->anchor()),
                      .finished = i < laser_graph.local_map().finished(),
                      .cell_m = kSavedCell_m,
                      .echoes = {}};
    set_echoes(submap, submaps[i]->points_m());
    kept.push_back(std::move(submap));
  }
}

}  // namespace

KeptSubmaps saved_graph(const KeptSubmaps& earlier, const LaserGraph& laser_graph,
                        std::span<const double> node_stamps_s, const Config& config) {
  KeptSubmaps kept = earlier;
  const TiedGraph& graph = laser_graph.graph();
  const std::size_t held = graph.held();
  if (held > 0 && graph.size() <= held + 1) return kept;
  const Numbers numbers(earlier);
  kept.nodes.reserve(graph.size());
  for (std::size_t node = held; node < graph.size(); ++node)
    kept.nodes.push_back({numbers.of(node), node_stamps_s[node], laser_graph.T_map(node)});
  add_edges(graph, numbers, kept.edges);
  add_submaps(laser_graph, graph.size(), numbers, kept.submaps);
  drop_covered(kept, config.submap_m);
  return kept;
}

}  // namespace cairn::submap_graph
