#include "tests/bench/graph/boost_searches.hpp"

#include <Eigen/Core>
#include <boost/graph/astar_search.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <limits>

#include "planners/landmark_search/graphs/boost_landmark_graph.hpp"

namespace cairn {
namespace {

using Graph = BoostLandmarkGraph::Graph;

struct Reached {};

template <class Base>
struct StopAt : Base {
  StopAt(std::size_t goal_vertex, std::int64_t& count) : goal(goal_vertex), settled(&count) {}
  void examine_vertex(std::size_t vertex, const Graph&) {
    ++*settled;
    if (vertex == goal) throw Reached{};
  }
  std::size_t goal;
  std::int64_t* settled;
};

}  // namespace

struct BoostSearches::Model {
  explicit Model(const LandmarkGraph& graph) : boost_graph(graph) {
    const std::size_t vertices = boost_graph.ids.size();
    cost_m.resize(vertices);
    bound_m.resize(vertices);
    before.resize(vertices);
    colour.resize(vertices);
  }
  template <class Value>
  auto map_of(std::vector<Value>& values) const {
    return boost::make_iterator_property_map(values.begin(), boost::get(boost::vertex_index, boost_graph.graph));
  }
  auto weights() const { return boost::get(&RouteEdge::cost_m, boost_graph.graph); }

  BoostLandmarkGraph boost_graph;
  std::vector<Eigen::Vector3d> places;
  std::vector<double> cost_m, bound_m;
  std::vector<std::size_t> before;
  std::vector<boost::default_color_type> colour;
};

BoostSearches::BoostSearches(const LandmarkGraph& graph, double floor_m) : model_(std::make_unique<Model>(graph)) {
  for (const auto& [id, landmark] : graph.landmarks()) {
    const Point place = landmark.T_map_landmark.position();
    model_->places.emplace_back(place.x(), place.y(), floor_m * landmark.level);
  }
}

BoostSearches::~BoostSearches() = default;

template <class Search>
double BoostSearches::stopped_at(std::size_t goal, Search search) {
  settled_ = 0;
  way_.clear();
  try {
    search();
    return std::numeric_limits<double>::infinity();
  } catch (const Reached&) {
  }
  for (std::size_t v = goal;; v = model_->before[v]) {
    way_.push_back(v);
    if (model_->before[v] == v) break;
  }
  return model_->cost_m[goal];
}

double BoostSearches::dijkstra(LandmarkId from, LandmarkId to) {
  Model& model = *model_;
  const std::size_t goal = model.boost_graph.vertex_of(to);
  return stopped_at(goal, [&] {
    boost::dijkstra_shortest_paths(model.boost_graph.graph, model.boost_graph.vertex_of(from),
                                   boost::weight_map(model.weights())
                                       .distance_map(model.map_of(model.cost_m))
                                       .predecessor_map(model.map_of(model.before))
                                       .color_map(model.map_of(model.colour))
                                       .visitor(StopAt<boost::default_dijkstra_visitor>(goal, settled_)));
  });
}

double BoostSearches::astar(LandmarkId from, LandmarkId to) {
  Model& model = *model_;
  const std::size_t goal = model.boost_graph.vertex_of(to);
  const auto straight_m = [&model, goal](std::size_t v) { return (model.places[v] - model.places[goal]).norm(); };
  return stopped_at(goal, [&] {
    boost::astar_search(model.boost_graph.graph, model.boost_graph.vertex_of(from), straight_m,
                        boost::weight_map(model.weights())
                            .distance_map(model.map_of(model.cost_m))
                            .rank_map(model.map_of(model.bound_m))
                            .predecessor_map(model.map_of(model.before))
                            .color_map(model.map_of(model.colour))
                            .visitor(StopAt<boost::default_astar_visitor>(goal, settled_)));
  });
}

const std::vector<double>& BoostSearches::dijkstra_tree(LandmarkId from) {
  Model& model = *model_;
  boost::dijkstra_shortest_paths(model.boost_graph.graph, model.boost_graph.vertex_of(from),
                                 boost::weight_map(model.weights())
                                     .distance_map(model.map_of(model.cost_m))
                                     .color_map(model.map_of(model.colour)));
  return model.cost_m;
}

}  // namespace cairn
