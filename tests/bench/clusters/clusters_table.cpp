// The tables of docs/results/clusters.md: how far the clusters of landmarks agree with the rooms of buildings.
//
//     clusters_table            even seeds and plans, which are reported
//     clusters_table tuning     odd ones, which settings were chosen on
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "framework/experiments/statistics.hpp"
#include "maps/hierarchy/hierarchy.hpp"
#include "tests/bench/clusters/agreement.hpp"
#include "tests/bench/clusters/explored_site.hpp"

namespace cairn {
namespace {

constexpr int kBuildings = 20;
constexpr std::uint64_t kSeedsPerPlan = 3;
constexpr double kLandmarkEvery_m2 = 6.0;

struct Case {
  const FloorPlan& plan;
  ExploredSite site;
};

using Labels = std::vector<int>;  // by rising landmark
using Method = std::function<Labels(const Case&)>;

Labels rooms_of(const Case& one) {
  Labels labels;
  for (const auto& [id, room] : one.site.room_of) labels.push_back(room);
  return labels;
}

Labels labels_of(const ClusterTree& tree, const Case& one) {
  Labels labels;
  for (const auto& [id, room] : one.site.room_of) labels.push_back(static_cast<int>(tree.cluster_of.at(id)));
  return labels;
}

Method by_passages(double narrow_below_m) {
  return [narrow_below_m](const Case& one) {
    ClusterSizes sizes;
    sizes.narrow_below_m = narrow_below_m;
    return labels_of(
        cluster_landmarks(one.site.graph, {}, {sizes, passages_in(one.plan.grid, one.site.graph, narrow_below_m)}),
        one);
  };
}

Labels by_length(const Case& one) {
  return labels_of(cluster_landmarks(one.site.graph), one);
}

// As large graphs are, with so small clusters that there are as many as rooms.
Labels by_metis_of_room_size(const Case& one) {
  const Labels rooms = rooms_of(one);
  const auto count = static_cast<double>(std::set<int>(rooms.begin(), rooms.end()).size());
  const auto leaf = std::max(2, static_cast<int>(std::lround(10.0 * static_cast<double>(rooms.size()) / 9.0 / count)));
  return labels_of(cluster_landmarks(one.site.graph, {}, ClusterSizes{.leaf = leaf, .growth = 64, .large_from = 8}),
                   one);
}

Labels each_alone(const Case& one) {
  Labels labels(one.site.room_of.size());
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = static_cast<int>(i);
  return labels;
}

// One cluster a room, as far as routes that stay in the room join its landmarks.
Labels joined_rooms(const Case& one) {
  LandmarkGraph graph = one.site.graph;
  std::vector<RouteId> between;
  for (const auto& [id, route] : graph.routes())
    if (one.site.room_of.at(route.from) != one.site.room_of.at(route.to)) between.push_back(id);
  for (const RouteId id : between) graph.remove_route(id);
  return labels_of(cluster_landmarks(graph, {}, {ClusterSizes{.leaf = 256}, [](const Route&) { return 99.0; }}), one);
}

struct Row {
  std::vector<double> clusters_per_room, nmi, rand_index, doors, whole;

  void add(const Case& one, const Labels& labels) {
    const Labels rooms = rooms_of(one);
    const std::set<int> with_landmarks(rooms.begin(), rooms.end());
    clusters_per_room.push_back(static_cast<double>(std::set<int>(labels.begin(), labels.end()).size()) /
                                static_cast<double>(with_landmarks.size()));
    nmi.push_back(normalised_mutual_information(labels, rooms));
    rand_index.push_back(adjusted_rand_index(labels, rooms));
    add_doors(one, labels, rooms, with_landmarks);
    add_routes(one, labels);
  }

  // Found: no cluster holds landmarks of both rooms.
  void add_doors(const Case& one, const Labels& labels, const Labels& rooms, const std::set<int>& with_landmarks) {
    std::set<std::pair<int, int>> held;  // rooms of one cluster
    for (std::size_t i = 0; i < labels.size(); ++i)
      for (std::size_t j = 0; j < labels.size(); ++j)
        if (labels[i] == labels[j]) held.insert(std::minmax(rooms[i], rooms[j]));
    int all = 0;
    int found = 0;
    for (const auto& [a, b] : one.plan.doors) {
      if (!with_landmarks.contains(a) || !with_landmarks.contains(b)) continue;
      ++all;
      found += held.contains({a, b}) ? 0 : 1;
    }
    if (all > 0) doors.push_back(static_cast<double>(found) / all);
  }

  void add_routes(const Case& one, const Labels& labels) {
    std::map<LandmarkId, int> label_of;
    for (const auto& [id, room] : one.site.room_of) label_of.emplace(id, labels[label_of.size()]);
    int all = 0;
    int kept = 0;
    for (const auto& [id, route] : one.site.graph.routes()) {
      if (one.site.room_of.at(route.from) != one.site.room_of.at(route.to)) continue;
      ++all;
      kept += label_of.at(route.from) == label_of.at(route.to) ? 1 : 0;
    }
    if (all > 0) whole.push_back(static_cast<double>(kept) / all);
  }
};

void print_table(const std::string& name, const std::vector<FloorPlan>& plans) {
  const std::vector<std::pair<std::string, Method>> methods{
      {"passages narrower than 1.3 m divide", by_passages(1.3)},
      {"the same, 1.1 m", by_passages(1.1)},
      {"the same, 1.5 m", by_passages(1.5)},
      {"METIS by lengths, 2 sqrt(n)", by_length},
      {"METIS, as many as rooms", by_metis_of_room_size},
      {"each landmark alone", each_alone},
      {"one cluster a room, joined", joined_rooms},
      {"one cluster a room", rooms_of},
  };
  std::vector<Row> rows(methods.size());
  std::vector<double> landmarks;
  for (const FloorPlan& plan : plans)
    for (std::uint64_t seed = 1; seed <= kSeedsPerPlan; ++seed) {
      const Case one{plan, explored_site(plan, kLandmarkEvery_m2, seed)};
      landmarks.push_back(static_cast<double>(one.site.room_of.size()));
      for (std::size_t m = 0; m < methods.size(); ++m) rows[m].add(one, methods[m].second(one));
    }
  fmt::print("\n{}: {} plans, {} sites, {} landmarks each\n\n", name, plans.size(), landmarks.size(),
             text_of(estimate_of(landmarks), 0));
  fmt::print("| clusters by | clusters a room | NMI | Rand index | doors found | routes in rooms kept |\n");
  fmt::print("|---|---:|---:|---:|---:|---:|\n");
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const auto text = [&](const std::vector<double>& values) { return text_of(estimate_of(values), 2); };
    fmt::print("| {} | {} | {} | {} | {} | {} |\n", methods[m].first, text(rows[m].clusters_per_room),
               text(rows[m].nmi), text(rows[m].rand_index), text(rows[m].doors), text(rows[m].whole));
  }
  std::fflush(stdout);
}

std::vector<FloorPlan> every_other(std::vector<FloorPlan> plans, bool tuning) {
  std::vector<FloorPlan> chosen;
  for (std::size_t i = tuning ? 0 : 1; i < plans.size(); i += 2) chosen.push_back(std::move(plans[i]));
  return chosen;
}

}  // namespace
}  // namespace cairn

int main(int argc, char** argv) {
  using namespace cairn;
  const bool tuning = argc > 1 && std::string(argv[1]) == "tuning";
  std::vector<FloorPlan> buildings;
  for (std::uint64_t seed = tuning ? 1 : 2; seed <= 2 * kBuildings; seed += 2)
    buildings.push_back(generated_building(seed));
  print_table("generated buildings", buildings);
  print_table("ipa_rooms, empty", every_other(ipa_rooms(false), tuning));
  print_table("ipa_rooms, furnished", every_other(ipa_rooms(true), tuning));
}
