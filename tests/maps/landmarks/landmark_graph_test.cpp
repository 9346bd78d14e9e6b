#include "maps/landmarks/landmark_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Landmark landmark_at(double x_m, double y_m, std::string category = "square", std::string name = "") {
  Landmark landmark;
  landmark.T_map_landmark = {x_m, y_m, 0.0};
  landmark.category = std::move(category);
  landmark.name = std::move(name);
  return landmark;
}

Route route_of(LandmarkId from, LandmarkId to, double cost_m) {
  Route route;
  route.from = from;
  route.to = to;
  route.cost_m = cost_m;
  return route;
}

Landmark with_id(LandmarkId id) {
  Landmark landmark;
  landmark.id = id;
  return landmark;
}

// Runs the call and returns the sentence of its invalid_argument.
template <typename Call>
std::string refusal_of(Call call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LandmarkGraph, GivesIdsFromOneUpwards) {
  LandmarkGraph graph;
  EXPECT_EQ(graph.add(landmark_at(0, 0)), 1);
  EXPECT_EQ(graph.add(landmark_at(1, 0)), 2);
  EXPECT_EQ(graph.add_route(route_of(1, 2, 1.0)), 1);
  EXPECT_EQ(graph.find(2)->id, 2);
  EXPECT_EQ(graph.find_route(1)->id, 1);
}

TEST(LandmarkGraph, NeverGivesAnIdTwiceWhateverIsRemoved) {
  LandmarkGraph graph;
  graph.add(landmark_at(0, 0));
  graph.add(landmark_at(1, 0));
  graph.add_route(route_of(1, 2, 1.0));
  graph.remove(2);
  EXPECT_EQ(graph.add(landmark_at(2, 0)), 3);
  EXPECT_EQ(graph.add_route(route_of(1, 3, 1.0)), 2);
}

TEST(LandmarkGraph, KeepsLoadedIdsAndContinuesBeyondTheGreatest) {
  LandmarkGraph graph;
  EXPECT_EQ(graph.add(with_id(12)), 12);
  EXPECT_EQ(graph.add(with_id(5)), 5);
  EXPECT_EQ(graph.add(landmark_at(0, 0)), 13);
}

TEST(LandmarkGraph, ReservedIdsStayRetiredAndAreNeverLowered) {
  LandmarkGraph graph;
  graph.reserve_ids(40, 7);
  graph.reserve_ids(2, 2);
  EXPECT_EQ(graph.add(landmark_at(0, 0)), 40);
  EXPECT_EQ(graph.add_route(route_of(40, 40, 0.0)), 7);
}

TEST(LandmarkGraph, RemovingALandmarkRemovesTheRoutesThatTouchIt) {
  LandmarkGraph graph;
  for (int i = 0; i < 3; ++i) graph.add(landmark_at(i, 0));
  graph.add_route(route_of(1, 2, 1.0));
  graph.add_route(route_of(2, 3, 1.0));
  const RouteId kept = graph.add_route(route_of(3, 1, 2.0));
  graph.remove(2);
  ASSERT_EQ(graph.routes().size(), 1U);
  EXPECT_EQ(graph.routes().begin()->first, kept);
  EXPECT_EQ(graph.route_between(1, 2), nullptr);
  EXPECT_EQ(graph.route_between(3, 1)->id, kept);
}

TEST(LandmarkGraph, ARetiredLandmarkKeepsItsHistoryButNothingFindsIt) {
  LandmarkGraph graph;
  Landmark landmark;
  landmark.category = "square";
  graph.add(landmark);
  graph.add(landmark);
  graph.add_route({0, 1, 2, 1.0, {}, false, false, 0});
  graph.retire(1, "gone");
  EXPECT_EQ(graph.find(1), nullptr);
  EXPECT_EQ(graph.of_category("square"), std::vector<LandmarkId>{2});
  EXPECT_TRUE(graph.routes().empty());
  EXPECT_EQ(graph.retired().at(1).reason, "gone");
  EXPECT_EQ(graph.retired().at(1).landmark.category, "square");
  landmark.id = 1;
  EXPECT_THROW(graph.add(landmark), std::invalid_argument) << "its id is taken for ever";
  EXPECT_THROW(graph.add_retired({landmark, ""}), std::invalid_argument);
  EXPECT_THROW(graph.add_retired({Landmark{}, ""}), std::invalid_argument) << "no id";
  EXPECT_THROW(graph.retire(1, "again"), std::invalid_argument);
  landmark.id = 9;
  graph.add_retired({landmark, "loaded"});
  EXPECT_EQ(graph.next_landmark_id(), 10);
}

TEST(LandmarkGraph, FindsByIdLabelAndByName) {
  LandmarkGraph graph;
  graph.add(landmark_at(0, 0, "square", "dock"));
  graph.add(landmark_at(1, 0, "square", "L1"));
  graph.add(landmark_at(2, 0, "square", "dock"));
  EXPECT_EQ(graph.find_by_name("L2")->id, 2);
  EXPECT_EQ(graph.find_by_name("dock")->id, 1) << "the lower id wins";
  EXPECT_EQ(graph.find_by_name("L1")->id, 1) << "L<id> always names that id";
}

TEST(LandmarkGraph, DoesNotFindWhatOnlyLooksLikeALabel) {
  LandmarkGraph graph;
  graph.add(landmark_at(0, 0));
  for (const char* text : {"", "L", "L0", "L01", "L1 ", "l1", "1", "L-1", "L2", "L99999999999999999999", "+L1"})
    EXPECT_EQ(graph.find_by_name(text), nullptr) << '"' << text << '"';
}

TEST(LandmarkGraph, LabelIsTheNameOrElseTheId) {
  LandmarkGraph graph;
  graph.add(landmark_at(0, 0, "square", "dock"));
  graph.add(landmark_at(1, 0));
  EXPECT_EQ(label_of(*graph.find(1)), "dock");
  EXPECT_EQ(label_of(*graph.find(2)), "L2");
}

TEST(LandmarkGraph, NearestLooksWithinTheGivenDistanceOnly) {
  LandmarkGraph graph;
  EXPECT_EQ(graph.nearest({0, 0}, kInfinity), nullptr);
  graph.add(landmark_at(3, 4));
  EXPECT_EQ(graph.nearest({0, 0}, 5.0)->id, 1) << "the distance itself counts";
  EXPECT_EQ(graph.nearest({0, 0}, 4.99), nullptr);
  EXPECT_EQ(graph.nearest({kNan, 0}, kInfinity), nullptr);
}

TEST(LandmarkGraph, NearestGivesTiesToTheLowerId) {
  LandmarkGraph graph;
  graph.add(landmark_at(1, 0));
  graph.add(landmark_at(-1, 0));
  EXPECT_EQ(graph.nearest({0, 0}, 2.0)->id, 1);
}

TEST(LandmarkGraph, ListsACategoryByRisingId) {
  LandmarkGraph graph;
  graph.add(landmark_at(0, 0, "square"));
  graph.add(landmark_at(0, 0, "circle"));
  graph.add(landmark_at(0, 0, "square"));
  EXPECT_THAT(graph.of_category("square"), ElementsAre(1, 3));
  EXPECT_THAT(graph.of_category("triangle"), IsEmpty());
}

TEST(LandmarkGraph, RouteBetweenIsTheCheapestOpenOneInThatDirection) {
  LandmarkGraph graph;
  for (int i = 0; i < 3; ++i) graph.add(landmark_at(i, 0));
  graph.add_route(route_of(1, 2, 3.0));
  const RouteId cheap = graph.add_route(route_of(1, 2, 1.0));
  graph.add_route(route_of(1, 2, 1.0));
  graph.add_route(route_of(2, 1, 0.5));
  graph.add_route(route_of(1, 3, 0.1));
  EXPECT_EQ(graph.route_between(1, 2)->id, cheap) << "of equals the lower id";
  graph.set_closed(cheap, true);
  EXPECT_EQ(graph.route_between(1, 2)->id, 3);
  graph.remove_route(3);
  EXPECT_EQ(graph.route_between(1, 2)->id, 1);
  graph.set_closed(1, true);
  EXPECT_EQ(graph.route_between(1, 2), nullptr);
  graph.set_closed(1, false);
  EXPECT_EQ(graph.route_between(1, 2)->id, 1);
}

const Route* cheapest_by_scanning(const LandmarkGraph& graph, LandmarkId from, LandmarkId to) {
  const Route* best = nullptr;
  for (const auto& [id, route] : graph.routes())
    if (route.from == from && route.to == to && !route.closed && (!best || route.cost_m < best->cost_m)) best = &route;
  return best;
}

TEST(LandmarkGraph, RouteBetweenEqualsAScanThroughAllRoutesAfterAnyEdits) {
  std::mt19937_64 random(20250101);
  const auto below = [&random](std::uint64_t n) { return static_cast<std::int64_t>(random() % n); };
  LandmarkGraph graph;
  for (int i = 0; i < 6; ++i) graph.add(landmark_at(i, 0));
  for (int edit = 0; edit < 400; ++edit) {
    const RouteId route = 1 + below(static_cast<std::uint64_t>(graph.next_route_id()));
    const auto any = [&] { return std::next(graph.landmarks().begin(), below(graph.landmarks().size()))->first; };
    if (below(4) > 0) graph.add_route(route_of(any(), any(), static_cast<double>(below(5))));
    if (graph.find_route(route) != nullptr) graph.set_closed(route, below(2) == 0);
    if (graph.find_route(route) != nullptr && below(3) == 0) graph.remove_route(route);
    if (below(60) == 0 && graph.landmarks().size() > 3) graph.remove(any());
    const LandmarkId from = any();
    const LandmarkId to = any();
    ASSERT_EQ(graph.route_between(from, to), cheapest_by_scanning(graph, from, to)) << "edit " << edit;
  }
}

TEST(LandmarkGraph, RefusesBadLandmarksWithASentence) {
  LandmarkGraph graph;
  graph.add(with_id(3));
  EXPECT_EQ(refusal_of([&] { graph.add(with_id(3)); }), "landmark 3 exists already");
  EXPECT_EQ(refusal_of([&] { graph.add(with_id(-1)); }), "landmark -1: an id must be in 1..9007199254740991");
  EXPECT_EQ(refusal_of([&] { graph.add(with_id(std::numeric_limits<LandmarkId>::max())); }),
            "landmark 9223372036854775807: an id must be in 1..9007199254740991");
  EXPECT_EQ(refusal_of([&] { graph.add(landmark_at(kNan, 0)); }), "landmark 0: its place is not finite");
  EXPECT_EQ(graph.landmarks().size(), 1U);
}

TEST(LandmarkGraph, RefusesBadRoutesWithASentence) {
  LandmarkGraph graph;
  graph.add(landmark_at(0, 0));
  EXPECT_EQ(refusal_of([&] { graph.add_route(route_of(1, 2, 1.0)); }), "route 0: there is no landmark 2");
  EXPECT_EQ(refusal_of([&] { graph.add_route(route_of(9, 1, 1.0)); }), "route 0: there is no landmark 9");
  EXPECT_EQ(refusal_of([&] { graph.add_route(route_of(1, 1, -0.5)); }),
            "route 0: cost_m must be finite and not negative, got -0.500000");
  EXPECT_EQ(refusal_of([&] { graph.add_route(route_of(1, 1, kNan)); }),
            "route 0: cost_m must be finite and not negative, got nan");
  EXPECT_EQ(refusal_of([&] { graph.add_route(route_of(1, 1, kInfinity)); }),
            "route 0: cost_m must be finite and not negative, got inf");
  Route crooked = route_of(1, 1, 1.0);
  crooked.trajectory = {{0, kInfinity, 0}};
  EXPECT_EQ(refusal_of([&] { graph.add_route(crooked); }), "route 0: its trajectory is not finite");
  EXPECT_TRUE(graph.routes().empty());
}

TEST(LandmarkGraph, RefusesToChangeWhatIsNotThere) {
  LandmarkGraph graph;
  EXPECT_EQ(refusal_of([&] { graph.remove(1); }), "there is no landmark 1 to remove");
  EXPECT_EQ(refusal_of([&] { graph.remove_route(2); }), "there is no route 2 to remove");
  EXPECT_EQ(refusal_of([&] { graph.set_closed(3, true); }), "there is no route 3 to close or open");
  EXPECT_EQ(graph.find(1), nullptr);
  EXPECT_EQ(graph.find_route(1), nullptr);
  EXPECT_EQ(graph.route_between(1, 2), nullptr);
}

}  // namespace
}  // namespace cairn
