#include "maps/clustering/grouping.hpp"

#include <fmt/format.h>
#include <metis.h>

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/property_map.hpp>
#include <map>
#include <numeric>
#include <stdexcept>

namespace cairn {
namespace {

static_assert(sizeof(idx_t) == sizeof(std::int32_t), "METIS with 32 bit numbers");

using Groups = std::vector<std::int32_t>;

// Union-find over the nodes (Boost.Graph's way to connected components of a graph that grows).
class Union {
 public:
  explicit Union(std::int32_t nodes)
      : rank_(static_cast<std::size_t>(nodes)),
        parent_(static_cast<std::size_t>(nodes)),
        sets_(numbers_in(rank_), numbers_in(parent_)) {
    for (std::int32_t i = 0; i < nodes; ++i) sets_.make_set(i);
  }
  void join(std::int32_t a, std::int32_t b) { sets_.union_set(a, b); }
  std::int32_t find(std::int32_t a) { return sets_.find_set(a); }

 private:
  // Not the bare pointers: Boost finds their get() only where no other header has included disjoint_sets before.
  using Numbers = boost::iterator_property_map<std::int32_t*, boost::typed_identity_property_map<std::int32_t>>;
  static Numbers numbers_in(std::vector<std::int32_t>& numbers) { return Numbers(numbers.data(), {}); }

  std::vector<std::int32_t> rank_, parent_;
  boost::disjoint_sets<Numbers, Numbers> sets_;
};

template <class Visit>
void for_each_edge(const GroupingGraph& graph, std::int32_t node, Visit visit) {
  const auto at = static_cast<std::size_t>(node);
  for (auto e = static_cast<std::size_t>(graph.begin[at]); e < static_cast<std::size_t>(graph.begin[at + 1]); ++e)
    visit(graph.other[e], graph.weight[e]);
}

// Numbered from 0 in the order in which they first occur.
Groups renumbered(const Groups& groups) {
  if (groups.empty()) return {};
  Groups number(static_cast<std::size_t>(*std::max_element(groups.begin(), groups.end())) + 1, -1);
  Groups result(groups.size());
  std::int32_t next = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    std::int32_t& name = number[static_cast<std::size_t>(groups[i])];
    if (name < 0) name = next++;
    result[i] = name;
  }
  return result;
}

// The connected pieces of the groups.
Groups components_of(const GroupingGraph& graph, const Groups& groups) {
  Union components(graph.nodes());
  for (std::int32_t node = 0; node < graph.nodes(); ++node)
    for_each_edge(graph, node, [&](std::int32_t other, std::int32_t) {
      if (groups[static_cast<std::size_t>(node)] == groups[static_cast<std::size_t>(other)])
        components.join(node, other);
    });
  Groups result(groups.size());
  for (std::int32_t node = 0; node < graph.nodes(); ++node)
    result[static_cast<std::size_t>(node)] = components.find(node);
  return renumbered(result);
}

std::vector<std::vector<std::int32_t>> members_of(const Groups& groups) {
  std::vector<std::vector<std::int32_t>> members;
  for (std::size_t node = 0; node < groups.size(); ++node) {
    const auto group = static_cast<std::size_t>(groups[node]);
    if (members.size() <= group) members.resize(group + 1);
    members[group].push_back(static_cast<std::int32_t>(node));
  }
  return members;
}

std::int64_t size_of(const GroupingGraph& graph, const std::vector<std::int32_t>& members) {
  std::int64_t size = 0;
  for (const std::int32_t node : members) size += graph.size[static_cast<std::size_t>(node)];
  return size;
}

// Groups below a quarter of what is allowed join the neighbour that most ties bind them to, the smallest first.
class SmallOnes {
 public:
  SmallOnes(const GroupingGraph& graph, Groups groups, std::int32_t most)
      : graph_(graph), groups_(std::move(groups)), members_(members_of(groups_)), max_(most) {
    for (const auto& members : members_) sizes_.push_back(size_of(graph, members));
  }

  Groups joined() {
    std::vector<std::size_t> order(members_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes_[a] < sizes_[b]; });
    for (const std::size_t group : order)
      if (!members_[group].empty() && 4 * sizes_[group] < max_) join(group);
    return renumbered(groups_);
  }

 private:
  void join(std::size_t group) {
    std::map<std::size_t, std::int64_t> ties;
    for (const std::int32_t node : members_[group])
      for_each_edge(graph_, node, [&](std::int32_t other, std::int32_t weight) {
        const auto neighbour = static_cast<std::size_t>(groups_[static_cast<std::size_t>(other)]);
        if (neighbour != group && sizes_[neighbour] + sizes_[group] <= max_) ties[neighbour] += weight;
      });
    if (ties.empty()) return;
    const std::size_t to =
        std::max_element(ties.begin(), ties.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
    for (const std::int32_t node : members_[group]) {
      groups_[static_cast<std::size_t>(node)] = static_cast<std::int32_t>(to);
      members_[to].push_back(node);
    }
    sizes_[to] += sizes_[group];
    members_[group].clear();
  }

  const GroupingGraph& graph_;
  Groups groups_;
  std::vector<std::vector<std::int32_t>> members_;
  std::vector<std::int64_t> sizes_;
  std::int64_t max_;
};

// The graph of some nodes alone.
GroupingGraph part_of(const GroupingGraph& graph, const std::vector<std::int32_t>& members) {
  std::map<std::int32_t, std::int32_t> number;
  for (const std::int32_t node : members) number.emplace(node, static_cast<std::int32_t>(number.size()));
  GroupingGraph part;
  for (const std::int32_t node : members) {
    for_each_edge(graph, node, [&](std::int32_t other, std::int32_t weight) {
      const auto found = number.find(other);
      if (found == number.end()) return;
      part.other.push_back(found->second);
      part.weight.push_back(weight);
    });
    part.begin.push_back(static_cast<std::int32_t>(part.other.size()));
    part.size.push_back(graph.size[static_cast<std::size_t>(node)]);
  }
  return part;
}

// Breadth first, a group is closed when the next node does not fit: always within `most`, whatever the graph.
Groups by_growth(const GroupingGraph& graph, std::int32_t most) {
  Groups groups(graph.size.size(), -1);
  std::int32_t group = -1;
  for (std::int32_t seed = 0; seed < graph.nodes(); ++seed) {
    if (groups[static_cast<std::size_t>(seed)] >= 0) continue;
    groups[static_cast<std::size_t>(seed)] = ++group;
    std::int64_t size = graph.size[static_cast<std::size_t>(seed)];
    std::vector<std::int32_t> queue{seed};
    for (std::size_t at = 0; at < queue.size(); ++at)
      for_each_edge(graph, queue[at], [&](std::int32_t other, std::int32_t) {
        const auto o = static_cast<std::size_t>(other);
        if (groups[o] >= 0 || size + graph.size[o] > most) return;
        groups[o] = group;
        size += graph.size[o];
        queue.push_back(other);
      });
  }
  return groups;
}

std::int32_t groups_for(std::int64_t total, std::int32_t most) {
  return static_cast<std::int32_t>((10 * total + 9 * std::int64_t{most} - 1) / (9 * std::int64_t{most}));
}

// Puts groups in the place of one that is too large.
void split(const GroupingGraph& graph, const std::vector<std::int32_t>& members, std::int32_t most,
           const Proposal& propose, Groups& groups, std::int32_t& next, int depth) {
  const GroupingGraph part = part_of(graph, members);
  const std::int32_t wanted = std::max(2, groups_for(size_of(graph, members), most));
  const Groups inner = depth > 8 ? by_growth(part, most) : components_of(part, propose(part, wanted));
  for (const auto& group : members_of(inner)) {
    std::vector<std::int32_t> nodes;
    nodes.reserve(group.size());
    for (const std::int32_t i : group) nodes.push_back(members[static_cast<std::size_t>(i)]);
    if (nodes.size() > 1 && size_of(graph, nodes) > most) {
      split(graph, nodes, most, propose, groups, next, depth + 1);
    } else {
      for (const std::int32_t node : nodes) groups[static_cast<std::size_t>(node)] = next;
      ++next;
    }
  }
}

}  // namespace

std::vector<std::int32_t> propose_by_metis(const GroupingGraph& graph, std::int32_t groups) {
  idx_t nodes = graph.nodes();
  idx_t constraints = 1;
  idx_t parts = std::min(groups, nodes);
  idx_t cut = 0;
  Groups part(graph.size.size(), 0);
  if (parts <= 1) return part;
  if (nodes < 2 * parts) {  // METIS may find no way to fill each part, and says so on standard output
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = static_cast<std::int32_t>(std::int64_t(i) * parts / nodes);
    return part;
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  // METIS does not write to what it reads, though its interface is older than const.
  const auto open = [](const std::vector<std::int32_t>& values) { return const_cast<idx_t*>(values.data()); };
  const auto partition = parts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status = partition(&nodes, &constraints, open(graph.begin), open(graph.other), open(graph.size), nullptr,
                               open(graph.weight), &parts, nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK) throw std::runtime_error(fmt::format("METIS failed with status {}", status));
  return part;
}

std::vector<std::int32_t> connected_groups(const GroupingGraph& graph, std::int32_t most, const Proposal& propose) {
  const std::int64_t total = std::accumulate(graph.size.begin(), graph.size.end(), std::int64_t{0});
  if (total <= most) return connected_parts(graph);
  Groups groups = components_of(graph, propose(graph, groups_for(total, most)));
  const auto members = members_of(groups);
  auto next = static_cast<std::int32_t>(members.size());
  for (const auto& nodes : members)
    if (nodes.size() > 1 && size_of(graph, nodes) > most) split(graph, nodes, most, propose, groups, next, 0);
  return SmallOnes(graph, renumbered(groups), most).joined();
}

std::vector<std::int32_t> connected_parts(const GroupingGraph& graph) {
  return components_of(graph, Groups(graph.size.size(), 0));
}

}  // namespace cairn
