#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "maps/clustering/clustering.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"

namespace cairn {
namespace {

// Rooms in a row, each of so many landmarks that are joined to the next in a ring; a door from each room to the next.
class Rooms {
 public:
  void add_room(int landmarks) {
    const LandmarkId first = graph.next_landmark_id();
    for (int i = 0; i < landmarks; ++i) graph.add({});
    for (int i = 0; i < landmarks; ++i) join(first + i, first + (i + 1) % landmarks, 2.5);
    if (!firsts.empty()) join(firsts.back(), first, 0.9);
    firsts.push_back(first);
  }
  void join(LandmarkId a, LandmarkId b, double width_m) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
      widths[graph.add_route({0, from, to, 2.0, {}, false, false, 0})] = width_m;
  }
  [[nodiscard]] PassageWidths known_widths() const {
    return [this](RouteId id) -> std::optional<double> { return widths.at(id); };
  }
  [[nodiscard]] int room_of(LandmarkId id) const {
    return static_cast<int>(std::ranges::upper_bound(firsts, id) - firsts.begin());
  }

  LandmarkGraph graph;
  std::map<RouteId, double> widths;
  std::vector<LandmarkId> firsts;
};

Clustering clusters_of(const Rooms& rooms, const Network& network, const ClusterSizes& sizes = {}) {
  return Clustering(network, sizes, propose_by_metis, rooms.known_widths());
}

std::set<std::set<LandmarkId>> groups_of(const ClusterTree& tree) {
  std::set<std::set<LandmarkId>> groups;
  for (const auto& [id, cluster] : tree.clusters) {
    const std::vector<LandmarkId> members = members_of(tree, id);
    groups.emplace(members.begin(), members.end());
  }
  return groups;
}

TEST(ClustersOfASmallGraph, AreTheRoomsBetweenNarrowPassages) {
  Rooms rooms;
  for (const int landmarks : {3, 5, 4}) rooms.add_room(landmarks);
  const Network network(rooms.graph, cost_by_length);
  const Clustering clustering = clusters_of(rooms, network);
  EXPECT_EQ(clustering.levels(), 1);
  EXPECT_TRUE(clustering.is_small());
  EXPECT_EQ(groups_of(clustering.tree(network)),
            (std::set<std::set<LandmarkId>>{{1, 2, 3}, {4, 5, 6, 7, 8}, {9, 10, 11, 12}}));
}

TEST(ClustersOfASmallGraph, BeginAtEightLandmarks) {
  Rooms rooms;
  for (const int landmarks : {3, 4}) rooms.add_room(landmarks);
  EXPECT_EQ(clusters_of(rooms, Network(rooms.graph, cost_by_length)).levels(), 0);
  rooms.graph.add({});
  EXPECT_EQ(clusters_of(rooms, Network(rooms.graph, cost_by_length)).levels(), 1);
}

TEST(ClustersOfASmallGraph, ARoomThatIsTooLargeIsDivided) {
  Rooms rooms;
  rooms.add_room(50);
  const Network network(rooms.graph, cost_by_length);
  const Clustering clustering = clusters_of(rooms, network);
  EXPECT_GE(clustering.of_level(1).size(), 2U);
  EXPECT_EQ(test::broken_law(clustering, network), "");
}

TEST(ClustersOfASmallGraph, WithoutPassagesAreCutByTheCostsOfRoutes) {
  LandmarkGraph graph;
  for (int i = 0; i < 12; ++i) graph.add({});
  for (LandmarkId id = 1; id < 12; ++id) graph.add_route({0, id, id + 1, id == 6 ? 30.0 : 1.0, {}, false, false, 0});
  const Network network(graph, cost_by_length);
  const Clustering clustering(network, {});
  EXPECT_EQ(groups_of(clustering.tree(network)),
            (std::set<std::set<LandmarkId>>{{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}}));
}

TEST(ClustersOfASmallGraph, GrowWithTheMapAndKeepTheirIdsAndNames) {
  Rooms rooms;
  for (const int landmarks : {4, 4}) rooms.add_room(landmarks);
  Network network(rooms.graph, cost_by_length);
  Clustering clustering = clusters_of(rooms, network);
  const auto kitchen = clustering.cluster_of(network.vertex_of(5), 1);
  clustering.set_name(kitchen, "kitchen");
  const ClusterId id = clustering.node(kitchen).id;
  const ClusterId other = clustering.node(clustering.cluster_of(network.vertex_of(1), 1)).id;
  rooms.add_room(5);
  rooms.join(5, rooms.graph.add({}), 2.0);
  network = Network(rooms.graph, cost_by_length);
  static_cast<void>(clustering.follow(network, {}, rooms.known_widths()));
  const ClusterTree tree = clustering.tree(network);
  EXPECT_EQ(tree.clusters.size(), 3U);
  EXPECT_EQ(tree.clusters.at(id).name, "kitchen");
  EXPECT_EQ(members_of(tree, id), (std::vector<LandmarkId>{5, 6, 7, 8, 14}));
  EXPECT_EQ(members_of(tree, other), (std::vector<LandmarkId>{1, 2, 3, 4}));
  EXPECT_EQ(tree.clusters.rbegin()->first, tree.next_id - 1) << "the new room has a new id";
}

TEST(ClustersOfASmallGraph, OfTwoNamedRoomsThatBecomeOneEachKeepsItsNameAndItsSide) {
  Rooms rooms;
  for (const int landmarks : {4, 4}) rooms.add_room(landmarks);
  const Network network(rooms.graph, cost_by_length);
  Clustering clustering = clusters_of(rooms, network);
  clustering.set_name(clustering.cluster_of(network.vertex_of(1), 1), "kitchen");
  clustering.set_name(clustering.cluster_of(network.vertex_of(5), 1), "hall");
  for (auto& [route, width_m] : rooms.widths) width_m = 2.0;
  static_cast<void>(clustering.follow(network, {}, rooms.known_widths()));
  const ClusterTree tree = clustering.tree(network);
  ASSERT_EQ(tree.clusters.size(), 2U);
  for (const auto& [name, landmark] : {std::pair("kitchen", 1), std::pair("hall", 5)}) {
    const Cluster* const cluster = find_cluster(tree, rooms.graph, name);
    ASSERT_NE(cluster, nullptr) << name;
    EXPECT_EQ(tree.cluster_of.at(landmark), cluster->id) << name;
  }
  EXPECT_EQ(test::broken_law(clustering, network), "");
}

TEST(ClustersOfASmallGraph, ComeBackAsSavedWhetherPassagesAreKnownOrNot) {
  Rooms rooms;
  for (const int landmarks : {3, 5, 4}) rooms.add_room(landmarks);
  const Network network(rooms.graph, cost_by_length);
  Clustering clustering = clusters_of(rooms, network);
  clustering.set_name(clustering.cluster_of(network.vertex_of(4), 1), "kitchen");
  const ClusterTree saved = clustering.tree(network);
  EXPECT_EQ(Clustering(network, {}, saved).tree(network), saved);
  EXPECT_EQ(Clustering(network, {}, saved, rooms.known_widths()).tree(network), saved);
}

TEST(ClustersOfASmallGraph, SavedOnesThatLackALandmarkAreFormedAnewUnderTheirNames) {
  Rooms rooms;
  for (const int landmarks : {4, 4}) rooms.add_room(landmarks);
  const Network before(rooms.graph, cost_by_length);
  Clustering clustering = clusters_of(rooms, before);
  clustering.set_name(clustering.cluster_of(before.vertex_of(5), 1), "kitchen");
  const ClusterTree saved = clustering.tree(before);
  rooms.join(8, rooms.graph.add({}), 1.8);
  const Network after(rooms.graph, cost_by_length);
  const ClusterTree tree = Clustering(after, {}, saved, rooms.known_widths()).tree(after);
  EXPECT_EQ(members_of(tree, saved.cluster_of.at(5)), (std::vector<LandmarkId>{5, 6, 7, 8, 9}));
  EXPECT_EQ(tree.clusters.at(saved.cluster_of.at(5)).name, "kitchen");
}

TEST(ClustersOfASmallGraph, KeepTheLawsWhenItGrowsLargeAndShrinksAgain) {
  const ClusterSizes sizes{.leaf = 8, .growth = 2, .large_from = 40};
  LandmarkGraph graph;
  test::GraphChanger changer(graph, 5);
  changer.grow_to(10);
  Hierarchy hierarchy(graph, {}, cost_by_length, sizes);
  const auto follow = [&](double growth, std::size_t until) {
    for (int step = 0; step < 600 && (growth > 0.5) == (graph.landmarks().size() < until); ++step) {
      hierarchy.update(graph, changer.change(growth));
      ASSERT_EQ(test::broken_law(hierarchy.clustering(), hierarchy.network()), "") << "step " << step;
    }
  };
  follow(0.9, 60);
  EXPECT_FALSE(hierarchy.clustering().is_small());
  EXPECT_GE(hierarchy.levels(), 2);
  follow(0.1, 20);
  EXPECT_TRUE(hierarchy.clustering().is_small());
  EXPECT_EQ(hierarchy.levels(), 1);
}

}  // namespace
}  // namespace cairn
