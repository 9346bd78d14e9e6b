#include "planners/landmark_search/boost_search.hpp"

#include <Eigen/Geometry>
#include <boost/graph/astar_search.hpp>
#include <functional>

#include "planners/landmark_search/answers.hpp"
#include "planners/landmark_search/graphs/query_graph.hpp"
#include "planners/landmark_search/refinement.hpp"

namespace cairn {
namespace {

using Label = BoostSearch::Label;

// A field of the labels as a property map.
template <auto kField>
struct LabelMap {
  using key_type = VertexIndex;
  using value_type = std::remove_reference_t<decltype(std::declval<Label&>().*kField)>;
  using reference = value_type&;
  using category = boost::lvalue_property_map_tag;
  Label* labels = nullptr;
  reference operator[](VertexIndex v) const { return labels[v].*kField; }
};
template <auto kField>
auto get(const LabelMap<kField>& map, VertexIndex v) {
  return map[v];
}
template <auto kField, class Value>
void put(const LabelMap<kField>& map, VertexIndex v, Value value) {
  map[v] = value;
}

struct ColourMap {
  using key_type = VertexIndex;
  using value_type = boost::default_color_type;
  using reference = value_type;
  using category = boost::read_write_property_map_tag;
  Label* labels = nullptr;
};
boost::default_color_type get(const ColourMap& map, VertexIndex v) {
  return static_cast<boost::default_color_type>(map.labels[v].colour);
}
void put(const ColourMap& map, VertexIndex v, boost::default_color_type colour) {
  map.labels[v].colour = static_cast<std::uint8_t>(colour);
}

class BoundToGoal {
 public:
  BoundToGoal(const Hierarchy& hierarchy, const RouteQuery& query, const QueryGraph& graph)
      : bound_(&hierarchy.bound()), start_(graph.start()), cost_per_m_(hierarchy.bound().cost_per_m()) {
    for (const auto& [route, cost] : query.costs)
      if (const auto [from, to] = hierarchy.network().ends_of(route); from != kNoVertex)
        cost_per_m_ = bound_->cost_per_m_with(cost_per_m_, from, to, cost);
    for (const SearchEnd& end : graph.goals()) {
      goals_.extend(bound_->place_of(end.vertex));
      least_cost_ = std::min(least_cost_, end.cost);
    }
    if (goals_.isEmpty() || !(least_cost_ < kNoRoute)) cost_per_m_ = least_cost_ = 0.0;
  }

  double operator()(VertexIndex v) const {
    if (v >= start_) return 0.0;  // also of the goal
    return cost_per_m_ > 0.0 ? cost_per_m_ * goals_.exteriorDistance(bound_->place_of(v)) + least_cost_ : least_cost_;
  }

 private:
  const StraightBound* bound_;
  VertexIndex start_;
  double cost_per_m_;
  Eigen::AlignedBox2d goals_;
  double least_cost_ = kNoRoute;  // of going on from a goal
};

struct Arrived {};
struct UsedUp {};

}  // namespace

class BoostSearch::Visitor : public boost::default_astar_visitor {
 public:
  Visitor(BoostSearch& search, const Budget& budget, GraphPath& path)
      : search_(&search), budget_(&budget), path_(&path) {}

  void discover_vertex(VertexIndex v, const QueryGraph&) {
    search_->labels_[v].number = static_cast<std::uint32_t>(search_->discovered_.size());
    search_->discovered_.push_back(v);
  }
  void edge_relaxed(const GraphEdge& edge, const QueryGraph&) { search_->labels_[edge.to].route = edge.route; }
  void examine_vertex(VertexIndex v, const QueryGraph& graph) {
    if (v == graph.goal()) throw Arrived{};
    if (v == graph.start()) return;
    const bool look = path_->settled % kSettledPerBudgetCheck == 0;
    if (path_->settled >= budget_->iterations || (look && budget_->exhausted())) throw UsedUp{};
    ++path_->settled;
    ++path_->settled_of_level[static_cast<std::size_t>(graph.level_of(v))];
  }

 private:
  BoostSearch* search_;
  const Budget* budget_;
  GraphPath* path_;
};

// Ends by an exception, or when nothing is left to examine.
void BoostSearch::search(const Hierarchy& hierarchy, const RouteQuery& query, const QueryGraph& graph,
                         Visitor visitor) {
  Label* const labels = labels_.data();
  const BoundToGoal bound(hierarchy, query, graph);
  labels[graph.start()].cost = 0.0;
  labels[graph.start()].rank = bound(graph.start());
  boost::astar_search_no_init(graph, graph.start(), bound, visitor, LabelMap<&Label::before>{labels},
                              LabelMap<&Label::rank>{labels}, LabelMap<&Label::cost>{labels},
                              get(boost::edge_weight, graph), ColourMap{labels}, LabelMap<&Label::number>{labels},
                              std::less<>(), std::plus<>(), kNoRoute, 0.0);
}

GraphPath BoostSearch::find(const Hierarchy& hierarchy, const RouteQuery& query, const Budget& budget) {
  GraphPath path;
  path.settled_of_level.assign(static_cast<std::size_t>(hierarchy.levels()) + 1, 0);
  clusters_.begin(hierarchy, query);
  const QueryGraph graph(hierarchy, query, clusters_);
  if (labels_.size() < graph.end()) labels_.resize(graph.end());
  try {
    search(hierarchy, query, graph, Visitor(*this, budget, path));
  } catch (const Arrived&) {
    refine(hierarchy, graph, path);
  } catch (const UsedUp&) {
    path.stopped = true;
  }
  for (const VertexIndex v : discovered_) labels_[v] = {};
  discovered_.clear();
  return path;
}

void BoostSearch::refine(const Hierarchy& hierarchy, const QueryGraph& graph, GraphPath& path) const {
  std::vector<VertexIndex> passed;  // from the goal back
  for (VertexIndex v = labels_[graph.goal()].before; v != graph.start(); v = labels_[v].before) passed.push_back(v);
  path.cost = labels_[graph.goal()].cost;
  path.vertices.push_back(passed.back());
  for (std::size_t i = passed.size() - 1; i > 0; --i) {
    const VertexIndex from = passed[i];
    const VertexIndex to = passed[i - 1];
    if (labels_[to].route != 0) {
      path.routes.push_back(labels_[to].route);
      path.vertices.push_back(to);
      continue;
    }
    const ClusterIndex cluster = clusters_.whole_around(from);
    const std::vector<VertexIndex>& boundary = hierarchy.clustering().node(cluster).boundary;
    append_passage(hierarchy, cluster, position_of(boundary, from), position_of(boundary, to), path);
  }
  if (const RouteId last = labels_[graph.goal()].route; last != 0) {  // to a landmark that is not passed
    path.routes.push_back(last);
    path.vertices.push_back(hierarchy.network().ends_of(last).second);
  }
  remove_loops(path);
}

}  // namespace cairn
