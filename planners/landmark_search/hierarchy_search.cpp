#include "planners/landmark_search/hierarchy_search.hpp"

#include <algorithm>
#include <functional>

#include "planners/landmark_search/answers.hpp"
#include "planners/landmark_search/refinement.hpp"

namespace cairn {
namespace {

constexpr std::size_t kFewestSlots = 256;

}  // namespace

GraphPath HierarchySearch::find(const Hierarchy& hierarchy, const RouteQuery& query, const Budget& budget) {
  GraphPath path;
  path.settled_of_level.assign(static_cast<std::size_t>(hierarchy.levels()) + 1, 0);
  begin(hierarchy, query);
  run(budget, path);
  if (path.stopped || meeting_.left == kNone) return path;
  unpack(path);
  remove_loops(path);
  return path;
}

void HierarchySearch::begin(const Hierarchy& hierarchy, const RouteQuery& query) {
  hierarchy_ = &hierarchy;
  query_ = &query;
  open_.begin(hierarchy, query);
  best_ = kNoRoute;
  frontier_ = {0.0, 0.0};
  meeting_ = {};
  nodes_.clear();
  frontier_ = {};
  slots_.assign(kFewestSlots, kNone);
  for (auto& queue : queues_) queue.clear();
  for (const int side : {0, 1})
    for (const SearchEnd& end : side == 0 ? query.from : query.to) relax(side, node_at(end.vertex), end.cost, kNone, 0);
}

HierarchySearch::NodeIndex& HierarchySearch::slot_of(VertexIndex v) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = (std::uint64_t{v} * 0x9E3779B97F4A7C15U >> 20) & mask;
  while (slots_[at] != kNone && nodes_[slots_[at]].vertex != v) at = (at + 1) & mask;
  return slots_[at];
}

void HierarchySearch::grow() {
  slots_.assign(2 * slots_.size(), kNone);
  for (NodeIndex n = 0; n < nodes_.size(); ++n) slot_of(nodes_[n].vertex) = n;
}

HierarchySearch::NodeIndex HierarchySearch::node_at(VertexIndex v, ClusterIndex cluster, std::uint32_t index) {
  NodeIndex& slot = slot_of(v);
  if (slot != kNone) return slot;
  const auto fresh = static_cast<NodeIndex>(nodes_.size());
  slot = fresh;
  nodes_.push_back({v, cluster, index, {}});
  if (2 * nodes_.size() > slots_.size()) grow();
  return fresh;
}

HierarchySearch::NodeIndex HierarchySearch::node_at(VertexIndex v) {
  if (const NodeIndex known = slot_of(v); known != kNone) return known;
  const ClusterIndex whole = hierarchy_->clustering().is_small() ? kNoCluster : open_.whole_around(v);
  if (whole != kNoCluster) {
    // It will be settled soon, and on large graphs most of the time goes by waiting for memory.
    const char* const passage = reinterpret_cast<const char*>(&hierarchy_->overlay().passage(whole));
    for (std::size_t line = 0; line < sizeof(Passage); line += 64) __builtin_prefetch(passage + line);
  }
  return node_at(v, whole, whole == kNoCluster ? 0 : position_of(hierarchy_->clustering().node(whole).boundary, v));
}

double HierarchySearch::cost_of(const Arc& arc) const {
  if (query_->costs.empty()) return arc.cost;
  const auto found = query_->costs.find(arc.route);
  return found == query_->costs.end() ? arc.cost : found->second;
}

void HierarchySearch::relax(int side, NodeIndex to, double cost, NodeIndex before, RouteId route) {
  const auto here = static_cast<std::size_t>(side);
  Node& node = nodes_[to];
  if (!(cost < node.label[here].cost)) return;
  if (const double whole = cost + node.label[1 - here].cost; whole < best_) {
    best_ = whole;
    meeting_ = {to, to, 0};
  } else if (!(cost + frontier_[1 - here] < best_)) {
    return;  // the other side has not been here, and will not come so cheaply that it matters
  }
  node.label[here] = {cost, before, route};
  queues_[here].emplace_back(cost, to);
  std::push_heap(queues_[here].begin(), queues_[here].end(), std::greater<>());
}

// One that has a node all the same is an end. It is not relaxed, or paths would continue from there.
void HierarchySearch::end_at_avoided(int side, NodeIndex at, const Arc& arc, double reached) {
  const NodeIndex end = slot_of(arc.other);
  if (end == kNone) return;
  const double cost = reached + nodes_[end].label[static_cast<std::size_t>(1 - side)].cost;
  if (!(cost < best_)) return;
  best_ = cost;
  meeting_ = side == 0 ? Meeting{at, end, arc.route} : Meeting{end, at, arc.route};
}

void HierarchySearch::relax_arc(int side, NodeIndex at, const Arc& arc) {
  const double cost = cost_of(arc);
  if (!(cost < kNoRoute)) return;
  const Label& label = nodes_[at].label[static_cast<std::size_t>(side)];
  const double reached = label.cost + cost;
  if (!(reached < best_)) return;
  if (label.before != kNone && nodes_[label.before].vertex == arc.other) return;  // straight back
  if (!query_->avoided.empty() && query_->avoided.contains(arc.other)) return end_at_avoided(side, at, arc, reached);
  relax(side, node_at(arc.other), reached, at, arc.route);
}

void HierarchySearch::settle(int side, NodeIndex at, GraphPath& path) {
  const Node node = nodes_[at];
  const Label& label = node.label[static_cast<std::size_t>(side)];
  const Network& network = hierarchy_->network();
  if (node.cluster == kNoCluster) {
    ++path.settled_of_level[0];
    for (const Arc& arc : side == 0 ? network.out(node.vertex) : network.in(node.vertex)) relax_arc(side, at, arc);
    return;
  }
  const ClusterNode& cluster = hierarchy_->clustering().node(node.cluster);
  const Passage& passage = hierarchy_->overlay().passage(node.cluster);
  ++path.settled_of_level[static_cast<std::size_t>(cluster.level)];
  const std::vector<Arc>& arcs = side == 0 ? passage.out : passage.in;
  const std::vector<std::uint32_t>& begin = side == 0 ? passage.out_begin : passage.in_begin;
  for (std::uint32_t a = begin[node.index]; a < begin[node.index + 1]; ++a) relax_arc(side, at, arcs[a]);
  // Two paths through the same cluster in a row are never better than one.
  if (label.route == 0 && label.before != kNone) return;
  const std::size_t count = passage.boundary();
  const double* const through = (side == 0 ? passage.through : passage.through_back).data() + node.index * count;
  for (std::uint32_t j = 0; j < count; ++j) {
    const double reached = label.cost + through[j];
    if (reached < best_ && j != node.index) relax(side, node_at(cluster.boundary[j], node.cluster, j), reached, at, 0);
  }
}

void HierarchySearch::run(const Budget& budget, GraphPath& path) {
  const auto drop_outdated = [&](std::size_t side) {
    Queue& queue = queues_[side];
    while (!queue.empty() && queue.front().first > nodes_[queue.front().second].label[side].cost) {
      std::pop_heap(queue.begin(), queue.end(), std::greater<>());
      queue.pop_back();
    }
  };
  for (;; ++path.settled) {
    if (path.settled >= budget.iterations || (path.settled % kSettledPerBudgetCheck == 0 && budget.exhausted())) {
      path.stopped = true;
      return;
    }
    drop_outdated(0);
    drop_outdated(1);
    if (queues_[0].empty() || queues_[1].empty()) return;
    frontier_ = {queues_[0].front().first, queues_[1].front().first};
    if (frontier_[0] + frontier_[1] >= best_) return;
    const std::size_t side = frontier_[0] <= frontier_[1] ? 0 : 1;
    const NodeIndex at = queues_[side].front().second;
    std::pop_heap(queues_[side].begin(), queues_[side].end(), std::greater<>());
    queues_[side].pop_back();
    settle(static_cast<int>(side), at, path);
  }
}

void HierarchySearch::unpack_step(int side, NodeIndex at, GraphPath& path) const {
  const Node& node = nodes_[at];
  const Label& label = node.label[static_cast<std::size_t>(side)];
  const Node& before = nodes_[label.before];
  if (label.route != 0) {
    path.routes.push_back(label.route);
    path.vertices.push_back(side == 0 ? node.vertex : before.vertex);
  } else if (side == 0) {
    append_passage(*hierarchy_, node.cluster, before.index, node.index, path);
  } else {
    append_passage(*hierarchy_, node.cluster, node.index, before.index, path);
  }
}

void HierarchySearch::unpack(GraphPath& path) const {
  std::vector<NodeIndex> forward;
  for (NodeIndex n = meeting_.left; nodes_[n].label[0].before != kNone; n = nodes_[n].label[0].before)
    forward.push_back(n);
  const NodeIndex start = forward.empty() ? meeting_.left : nodes_[forward.back()].label[0].before;
  path.vertices.push_back(nodes_[start].vertex);
  for (auto n = forward.rbegin(); n != forward.rend(); ++n) unpack_step(0, *n, path);
  if (meeting_.route != 0) {
    path.routes.push_back(meeting_.route);
    path.vertices.push_back(nodes_[meeting_.right].vertex);
  }
  NodeIndex goal = meeting_.right;
  for (; nodes_[goal].label[1].before != kNone; goal = nodes_[goal].label[1].before) unpack_step(1, goal, path);
  path.cost = best_;
}

}  // namespace cairn
