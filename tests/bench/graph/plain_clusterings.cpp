#include "tests/bench/graph/plain_clusterings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <numeric>

namespace cairn {
namespace {

using Graph = boost::compressed_sparse_row_graph<boost::directedS>;

Graph boost_graph_of(const GroupingGraph& graph) {
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  for (std::size_t node = 0; node < graph.size.size(); ++node)
    for (auto e = static_cast<std::size_t>(graph.begin[node]); e < static_cast<std::size_t>(graph.begin[node + 1]); ++e)
      ends.emplace_back(node, static_cast<std::size_t>(graph.other[e]));
  return {boost::edges_are_unsorted_multi_pass, ends.begin(), ends.end(), graph.size.size()};
}

struct Full {};

// Gives what it takes from the queue to the region, until that is full.
class Region : public boost::default_bfs_visitor {
 public:
  Region(const GroupingGraph& graph, std::int64_t wanted, std::vector<std::size_t>& taken,
         std::vector<std::size_t>& seen)
      : graph_(&graph), left_(wanted), taken_(&taken), seen_(&seen) {}
  void discover_vertex(std::size_t node, const Graph&) { seen_->push_back(node); }
  void examine_vertex(std::size_t node, const Graph&) {
    if (left_ <= 0) throw Full{};
    left_ -= graph_->size[node];
    taken_->push_back(node);
  }

 private:
  const GroupingGraph* graph_;
  std::int64_t left_;
  std::vector<std::size_t>*taken_, *seen_;
};

class Boxes {
 public:
  Boxes(const LandmarkGraph& graph, const ClusterSizes& sizes, double floor_m) : sizes_(sizes) {
    std::vector<std::size_t> all;
    for (const auto& [id, landmark] : graph.landmarks()) {
      const Point place = landmark.T_map_landmark.position();
      all.push_back(ids_.size());
      ids_.push_back(id);
      places_.emplace_back(place.x(), place.y(), floor_m * landmark.level);
    }
    if (const int levels = sizes.levels_for(all.size()); levels > 0) halve(all, levels, 0);
  }
  ClusterTree tree() && { return std::move(tree_); }

 private:
  void halve(std::span<std::size_t> some, int level, ClusterId parent) {
    if (some.size() <= static_cast<std::size_t>(sizes_.most(level))) return make(some, level, parent);
    Eigen::AlignedBox3d box;
    for (const std::size_t i : some) box.extend(places_[i]);
    Eigen::Index side = 0;
    box.sizes().maxCoeff(&side);
    const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
    std::nth_element(some.begin(), middle, some.end(),
                     [&](std::size_t a, std::size_t b) { return places_[a][side] < places_[b][side]; });
    halve(some.first(some.size() / 2), level, parent);
    halve(some.subspan(some.size() / 2), level, parent);
  }
  void make(std::span<std::size_t> some, int level, ClusterId parent) {
    const ClusterId id = tree_.next_id++;
    tree_.clusters[id] = {id, level, parent, ids_[some.front()], ""};
    if (level > 1) return halve(some, level - 1, id);
    for (const std::size_t i : some) tree_.cluster_of[ids_[i]] = id;
  }

  ClusterSizes sizes_;
  std::vector<LandmarkId> ids_;
  std::vector<Eigen::Vector3d> places_;
  ClusterTree tree_;
};

}  // namespace

std::vector<std::int32_t> propose_by_growth(const GroupingGraph& graph, std::int32_t groups) {
  const Graph model = boost_graph_of(graph);
  const std::int64_t total = std::accumulate(graph.size.begin(), graph.size.end(), std::int64_t{0});
  std::vector<std::int32_t> group_of(graph.size.size(), -1);
  std::vector<boost::default_color_type> colour(graph.size.size(), boost::white_color);
  const auto colours = boost::make_iterator_property_map(colour.begin(), boost::get(boost::vertex_index, model));
  std::int32_t group = 0;
  std::vector<std::size_t> taken, seen;
  for (std::size_t seed = 0; seed < group_of.size(); ++seed) {
    if (group_of[seed] >= 0) continue;
    taken.clear();
    seen.clear();
    boost::queue<std::size_t> queue;
    try {
      boost::breadth_first_visit(model, seed, queue, Region(graph, total / groups, taken, seen), colours);
    } catch (const Full&) {
    }
    for (const std::size_t node : seen) colour[node] = boost::white_color;
    for (const std::size_t node : taken) {
      colour[node] = boost::black_color;
      group_of[node] = group;
    }
    ++group;
  }
  return group_of;
}

ClusterTree clusters_by_coordinates(const LandmarkGraph& graph, const ClusterSizes& sizes, double floor_m) {
  return Boxes(graph, sizes, floor_m).tree();
}

}  // namespace cairn
