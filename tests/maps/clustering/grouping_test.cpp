#include "maps/clustering/grouping.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <random>
#include <set>

namespace cairn {
namespace {

struct Edge {
  std::int32_t a = 0;
  std::int32_t b = 0;
  std::int32_t weight = 1;
};

// Edges between the same nodes count as one of their weights together; sizes of 1 unless given.
GroupingGraph graph_of(std::int32_t nodes, const std::vector<Edge>& edges, std::vector<std::int32_t> sizes = {}) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> weights;
  for (const Edge& edge : edges)
    if (edge.a != edge.b) {
      weights[{edge.a, edge.b}] += edge.weight;
      weights[{edge.b, edge.a}] += edge.weight;
    }
  GroupingGraph graph;
  for (std::int32_t node = 0; node < nodes; ++node) {
    for (auto at = weights.lower_bound({node, 0}); at != weights.end() && at->first.first == node; ++at) {
      graph.other.push_back(at->first.second);
      graph.weight.push_back(at->second);
    }
    graph.begin.push_back(static_cast<std::int32_t>(graph.other.size()));
  }
  graph.size = sizes.empty() ? std::vector<std::int32_t>(static_cast<std::size_t>(nodes), 1) : std::move(sizes);
  return graph;
}

template <class Visit>
void for_each_edge(const GroupingGraph& graph, Visit visit) {
  for (std::int32_t node = 0; node < graph.nodes(); ++node)
    for (std::int32_t e = graph.begin[static_cast<std::size_t>(node)];
         e < graph.begin[static_cast<std::size_t>(node) + 1]; ++e)
      visit(node, graph.other[static_cast<std::size_t>(e)]);
}

// The part of its group that each node is in, by spreading the lowest number until nothing changes.
std::vector<std::int32_t> parts_by_spreading(const GroupingGraph& graph, const std::vector<std::int32_t>& groups) {
  std::vector<std::int32_t> part(groups.size());
  std::iota(part.begin(), part.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for_each_edge(graph, [&](std::int32_t a, std::int32_t b) {
      const auto from = static_cast<std::size_t>(a);
      const auto to = static_cast<std::size_t>(b);
      if (groups[from] != groups[to] || part[from] >= part[to]) return;
      part[to] = part[from];
      changed = true;
    });
  }
  return part;
}

// The first promise that the groups break, or nothing.
std::string broken_promise(const GroupingGraph& graph, std::int32_t most, const std::vector<std::int32_t>& groups) {
  if (groups.size() != graph.size.size()) return "not every node has a group";
  std::map<std::int32_t, std::int64_t> sizes;
  std::map<std::int32_t, int> nodes;
  for (std::size_t node = 0; node < groups.size(); ++node) {
    if (groups[node] < 0 || groups[node] > static_cast<std::int32_t>(sizes.size())) return "numbers are not in order";
    sizes[groups[node]] += graph.size[node];
    ++nodes[groups[node]];
  }
  for (const auto& [group, size] : sizes)
    if (size > most && nodes[group] > 1) return "group " + std::to_string(group) + " is too large";
  const std::vector<std::int32_t> parts = parts_by_spreading(graph, groups);
  if (std::set(parts.begin(), parts.end()).size() != sizes.size()) return "a group is in pieces";
  std::string broken;
  for_each_edge(graph, [&](std::int32_t a, std::int32_t b) {
    const std::int32_t here = groups[static_cast<std::size_t>(a)];
    const std::int32_t there = groups[static_cast<std::size_t>(b)];
    if (here != there && 4 * sizes[here] < most && sizes[here] + sizes[there] <= most)
      broken = "group " + std::to_string(here) + " is small and a neighbour has room";
  });
  return broken;
}

GroupingGraph random_graph(std::mt19937_64& random) {
  const auto nodes = static_cast<std::int32_t>(1 + random() % 300);
  std::vector<Edge> edges;
  const auto any = [&] { return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(nodes)); };
  for (std::uint64_t i = random() % static_cast<std::uint64_t>(3 * nodes); i > 0; --i)
    edges.push_back({any(), any(), static_cast<std::int32_t>(1 + random() % 10)});
  std::vector<std::int32_t> sizes;
  for (std::int32_t i = 0; i < nodes; ++i)
    sizes.push_back(random() % 50 == 0 ? 1'000'000 : static_cast<std::int32_t>(1 + random() % 4));
  return graph_of(nodes, edges, sizes);
}

TEST(Grouping, RandomGraphsComeOutConnectedAndWithinBounds) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    const GroupingGraph graph = random_graph(random);
    const auto most = static_cast<std::int32_t>(2 + random() % 60);
    const std::vector<std::int32_t> groups = connected_groups(graph, most);
    ASSERT_EQ(broken_promise(graph, most, groups), "") << "seed " << seed;
    ASSERT_EQ(connected_groups(graph, most), groups) << "seed " << seed << ": the same graph, other groups";
  }
}

TEST(Grouping, WhateverIsProposedIsRepaired) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    const GroupingGraph graph = random_graph(random);
    const auto most = static_cast<std::int32_t>(2 + random() % 60);
    const auto by = [&](auto number) {
      return connected_groups(graph, most, [&](const GroupingGraph& part, std::int32_t groups) {
        std::vector<std::int32_t> proposed;
        for (std::int32_t node = 0; node < part.nodes(); ++node) proposed.push_back(number(node, groups));
        return proposed;
      });
    };
    EXPECT_EQ(broken_promise(graph, most, by([](auto, auto) { return 0; })), "") << "all in one, seed " << seed;
    EXPECT_EQ(broken_promise(graph, most, by([](auto node, auto) { return node; })), "") << "all alone, seed " << seed;
    EXPECT_EQ(broken_promise(graph, most, by([](auto node, auto) { return node % 2 == 0 ? 90'000 : 7; })), "")
        << "with gaps, seed " << seed;
    EXPECT_EQ(broken_promise(graph, most, by([&](auto, std::int32_t groups) {
                               return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(groups));
                             })),
              "")
        << "at random, seed " << seed;
  }
}

TEST(Grouping, StarsCliquesPathsAndRingsAreCutTooWhereTheyCanBe) {
  std::vector<Edge> star;
  std::vector<Edge> clique;
  std::vector<Edge> path;
  for (std::int32_t a = 1; a < 200; ++a) {
    star.push_back({0, a});
    path.push_back({a - 1, a});
    for (std::int32_t b = 0; a < 60 && b < a; ++b) clique.push_back({a, b});
  }
  for (const std::int32_t most : {2, 3, 10, 50}) {
    for (const auto& [nodes, edges] : {std::pair(200, star), std::pair(200, path), std::pair(60, clique)}) {
      const GroupingGraph graph = graph_of(nodes, edges);
      EXPECT_EQ(broken_promise(graph, most, connected_groups(graph, most)), "") << most;
    }
    const GroupingGraph alone = graph_of(200, {});
    EXPECT_EQ(connected_groups(alone, most).back(), 199) << "nodes without edges are groups alone";
  }
}

TEST(Grouping, APathIsCutIntoAboutAsManyGroupsAsItsSizeAsksFor) {
  std::vector<Edge> path;
  for (std::int32_t a = 1; a < 1000; ++a) path.push_back({a - 1, a});
  const std::vector<std::int32_t> groups = connected_groups(graph_of(1000, path), 50);
  const std::size_t count = std::set(groups.begin(), groups.end()).size();
  EXPECT_GE(count, 20U);
  EXPECT_LE(count, 30U);
}

TEST(Grouping, WeakTiesAreCutFirst) {
  // Two rings of ten, joined by one weak edge.
  std::vector<Edge> edges{{0, 10, 1}};
  for (std::int32_t i = 0; i < 10; ++i)
    for (const std::int32_t first : {0, 10}) edges.push_back({first + i, first + (i + 1) % 10, 10});
  const std::vector<std::int32_t> groups = connected_groups(graph_of(20, edges), 12);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(groups[i], i < 10 ? 0 : 1) << i;
}

TEST(Grouping, OfNothingThereIsNone) {
  EXPECT_TRUE(connected_groups(graph_of(0, {}), 5).empty());
  EXPECT_TRUE(connected_parts(graph_of(0, {})).empty());
  EXPECT_EQ(connected_groups(graph_of(1, {}, {1000}), 5), std::vector<std::int32_t>{0}) << "a node too large";
}

TEST(Grouping, PartsAreNumberedByTheirLowestNode) {
  EXPECT_EQ(connected_parts(graph_of(6, {{0, 3}, {1, 5}, {5, 2}})), (std::vector<std::int32_t>{0, 1, 1, 0, 2, 1}));
}

}  // namespace
}  // namespace cairn
