// Questions to a graph without a grid, as a user asks them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

//          (4) store
//       14.5/  \15       all both ways at 10, but 1 -> 4, 4 -> 3 and 3 -> 5;
//   (1)--(2)--(3)--(5)   routes 3 and 9 are parallel, 2 -> 3 at 10 and at 12;
//  entrance hall kitchen balcony       (6) shed: alone
const char* const kHouse =
    "node 1 0 0 entrance\nnode 2 10 0 hall\nnode 3 20 0 kitchen\nnode 4 10 10 store\nnode 5 30 0 balcony\n"
    "node 6 50 50 shed\n"
    "edge 1 2 10\nedge 2 1 10\nedge 2 3 10\nedge 3 2 10\nedge 2 4 10\nedge 4 3 15\nedge 1 4 14.5\nedge 3 5 10\n"
    "edge 2 3 12\n";

class GraphQueries : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string map() const { return file("map.cairn"); }
  void import(const std::string& text) const {
    write_text(file("in.graph"), text);
    const Finished finished = run_cairn({"map", "import", file("in.graph"), "-o", map()});
    ASSERT_EQ(finished.exit_status, 0) << finished.err;
  }
  [[nodiscard]] Finished run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"plan", map()});
    return run_cairn(arguments);
  }
  // The answer to one question; the exit status must be as its outcome.
  [[nodiscard]] json ask(std::vector<std::string> arguments) const {
    arguments.emplace_back("--json");
    const Finished finished = run(arguments);
    const json answer = json::parse(finished.out, nullptr, false);
    EXPECT_TRUE(answer.is_object()) << finished.out << finished.err;
    EXPECT_EQ(finished.exit_status, answer.value("outcome", "") == "solved" ? 0 : 1) << finished.out;
    return answer;
  }
  [[nodiscard]] json from_to(const std::string& from, const std::string& to, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"--from", from, "--to", to});
    return ask(more);
  }
  // Answers to a file of queries, in its order.
  [[nodiscard]] std::vector<json> answers(const std::string& queries, std::vector<std::string> more = {}) const {
    write_text(file("q.jsonl"), queries);
    more.insert(more.begin(), {"--queries", file("q.jsonl"), "--json"});
    std::istringstream lines(run(more).out);
    std::vector<json> all;
    for (std::string line; std::getline(lines, line);) all.push_back(json::parse(line, nullptr, false));
    return all;
  }

  const std::filesystem::path folder_ = fresh_folder("graph_queries");
};

// `side` x `side` landmarks with random costs both ways; the seed names them.
std::string city(int side, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> cents(500, 1000);
  std::ostringstream text;
  const auto id = [&](int x, int y) { return y * side + x + 1; };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) text << "node " << id(x, y) << ' ' << 5 * x << ' ' << 5 * y << "\n";
  const auto join = [&](int a, int b) {
    text << "edge " << a << ' ' << b << ' ' << cents(random) / 100.0 << "\n";
    text << "edge " << b << ' ' << a << ' ' << cents(random) / 100.0 << "\n";
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (x + 1 < side) join(id(x, y), id(x + 1, y));
      if (y + 1 < side) join(id(x, y), id(x, y + 1));
    }
  return text.str();
}

TEST_F(GraphQueries, CostIsTheSumOfTheCostsAndLandmarksAreTheWholeWay) {
  import(kHouse);
  const json answer = from_to("L1", "balcony");
  EXPECT_EQ(answer["outcome"], "solved");
  EXPECT_EQ(answer["cost_m"], 30.0);
  EXPECT_EQ(answer["landmarks"], json({"L1", "L2", "L3", "L5"}));
  EXPECT_EQ(answer["routes"], json({1, 3, 8}));
  EXPECT_EQ(answer["path"].size(), 4U);
  EXPECT_FALSE(answer.contains("alternatives"));
  EXPECT_FALSE(answer.contains("explanation"));
}

TEST_F(GraphQueries, PeopleReadCostAndWay) {
  import(kHouse);
  const Finished finished = run({"--from", "L1", "--to", "kitchen"});
  EXPECT_EQ(finished.exit_status, 0);
  EXPECT_THAT(finished.out, testing::MatchesRegex("L1 -> kitchen: solved, cost 20.00 m, [0-9.]+ ms, by way of L1 L2 "
                                                  "L3\n  by 2 stored routes\n"));
}

TEST_F(GraphQueries, ViaPassesThePlacesInTheirOrder) {
  import(kHouse);
  const json answer = from_to("L1", "balcony", {"--via", "store", "--via", "hall"});
  EXPECT_EQ(answer["landmarks"], json({"L1", "L4", "L3", "L2", "L3", "L5"}));
  EXPECT_EQ(answer["cost_m"], 14.5 + 15.0 + 10.0 + 10.0 + 10.0);
  const json stuck = from_to("L1", "hall", {"--via", "kitchen", "--via", "shed"});
  EXPECT_EQ(stuck["outcome"], "no_route");
  EXPECT_EQ(stuck["reason"], "leg 2 of 3: no open route leads from kitchen to shed");
}

TEST_F(GraphQueries, AvoidKeepsOffLandmarks) {
  import(kHouse);
  EXPECT_EQ(from_to("L1", "L3", {"--avoid", "hall"})["landmarks"], json({"L1", "L4", "L3"}));
  EXPECT_EQ(from_to("L1", "L3", {"--avoid", "L1", "--avoid", "L3"})["cost_m"], 20.0);  // the ends may be among them
  const json none = from_to("L1", "L3", {"--avoid", "hall", "--avoid", "L4"});
  EXPECT_EQ(none["outcome"], "no_route");
  EXPECT_EQ(none["reason"], "no open route leads from entrance to kitchen past what is to be avoided");
}

TEST_F(GraphQueries, ClosedRoutesAreNotTakenAndTheExplanationSaysWhichStoodInTheWay) {
  import(kHouse);
  EXPECT_EQ(from_to("L1", "L3", {"--close", "3"})["routes"], json({1, 9}));
  const std::vector<std::string> both{"--close", "R3", "--close", "9", "--explain"};
  const json answer = from_to("L1", "L3", both);
  EXPECT_EQ(answer["cost_m"], 29.5);
  EXPECT_EQ(answer["explanation"]["cost"], 29.5);
  EXPECT_EQ(answer["explanation"]["cost_with_closed_open"], 20.0);
  EXPECT_EQ(answer["explanation"]["closed_on_cheaper_path"], json({3}));
  std::vector<std::string> arguments{"--from", "L1", "--to", "L3"};
  arguments.insert(arguments.end(), both.begin(), both.end());
  EXPECT_THAT(run(arguments).out, HasSubstr("  by length: 29.50 m; settled 4 landmarks\n"
                                            "  with every closed route open it would be 20.00 m, over R3\n"));
  const json cut = from_to("L1", "balcony", {"--close", "8", "--explain"});
  EXPECT_EQ(cut["outcome"], "no_route");
  EXPECT_EQ(cut["reason"], "no open route leads from entrance to balcony; with every closed route open one would");
  EXPECT_EQ(cut["explanation"]["cost"], nullptr);
  EXPECT_EQ(cut["explanation"]["closed_on_cheaper_path"], json({8}));
}

TEST_F(GraphQueries, AlternativesComeTheCheapestFirstAsManyAsThereAre) {
  import(kHouse);
  const json answer = from_to("L1", "L3", {"--alternatives", "9"});
  EXPECT_EQ(answer["alternatives"], json::parse(R"([
      {"cost_m": 22.0, "landmarks": ["L1", "L2", "L3"], "routes": [1, 9]},
      {"cost_m": 29.5, "landmarks": ["L1", "L4", "L3"], "routes": [7, 6]},
      {"cost_m": 35.0, "landmarks": ["L1", "L2", "L4", "L3"], "routes": [1, 5, 6]}])"));
  EXPECT_EQ(from_to("L1", "L3", {"--alternatives", "1"})["alternatives"].size(), 1U);
  EXPECT_THAT(run({"--from", "L1", "--to", "L3", "--alternatives", "1"}).out,
              HasSubstr("  or by routes of 22.00 m in all: L1 L2 L3\n"));
}

TEST_F(GraphQueries, CostByTimeIsReportedInSecondsAndTheSumInMetres) {
  // The short route is a slow one.
  write_text(file("in.geojson"), R"({"type": "FeatureCollection", "crs": {"type": "name", "properties":
      {"name": "urn:ogc:def:crs:EPSG::3857"}}, "features": [
      {"type": "Feature", "properties": {"id": 1}, "geometry": {"type": "Point", "coordinates": [0, 0]}},
      {"type": "Feature", "properties": {"id": 2}, "geometry": {"type": "Point", "coordinates": [4, 0]}},
      {"type": "Feature", "properties": {"id": 3}, "geometry": {"type": "Point", "coordinates": [2, 1]}},
      {"type": "Feature", "properties": {"id": 11, "startid": 1, "endid": 2, "metadata": {"abs_speed_limit": 0.01}},
       "geometry": {"type": "MultiLineString", "coordinates": [[[0, 0], [4, 0]]]}},
      {"type": "Feature", "properties": {"id": 12, "startid": 1, "endid": 3},
       "geometry": {"type": "MultiLineString", "coordinates": [[[0, 0], [2, 1]]]}},
      {"type": "Feature", "properties": {"id": 13, "startid": 3, "endid": 2},
       "geometry": {"type": "MultiLineString", "coordinates": [[[2, 1], [4, 0]]]}}]})");
  ASSERT_EQ(run_cairn({"map", "import", file("in.geojson"), "-o", map()}).exit_status, 0);
  EXPECT_EQ(from_to("L1", "L2", {"--explain"})["explanation"]["cost_unit"], "m");
  const json slow = from_to("L1", "L2", {"--cost", "time", "--avoid", "L3", "--explain"});
  EXPECT_EQ(slow["cost_m"], 4.0);
  EXPECT_EQ(slow["explanation"]["cost"], 400.0);
  EXPECT_EQ(slow["explanation"]["cost_by"], "time");
  EXPECT_EQ(slow["explanation"]["cost_unit"], "s");
  const json quick = from_to("L1", "L2", {"--cost", "time"});
  EXPECT_EQ(quick["routes"], json({12, 13}));
  EXPECT_NEAR(quick["cost_m"], 2.0 * std::sqrt(5.0), 1e-9);
  EXPECT_EQ(from_to("L1", "L2", {"--cost", "clearance"})["routes"], json({11}));  // without a grid as by length
}

TEST_F(GraphQueries, OneWayUnreachableAndTheStartItself) {
  import(kHouse);
  EXPECT_EQ(from_to("balcony", "L1")["outcome"], "no_route");
  const json shed = from_to("L1", "shed", {"--explain"});
  EXPECT_EQ(shed["outcome"], "no_route");
  EXPECT_EQ(shed["reason"], "no open route leads from entrance to shed");
  EXPECT_EQ(shed["explanation"]["cost_with_closed_open"], nullptr);
  EXPECT_THAT(run({"--from", "balcony", "--to", "hall", "--explain"}).out,
              HasSubstr("  by length: no route; settled 1 landmark\n"));
  const json here = from_to("L2", "hall", {"--alternatives", "2", "--explain"});
  EXPECT_EQ(here["cost_m"], 0.0);
  EXPECT_EQ(here["landmarks"], json({"L2"}));
  EXPECT_EQ(here["alternatives"], json::array());
  EXPECT_EQ(here["explanation"]["cost"], 0.0);
}

TEST_F(GraphQueries, NearestIsTheCheapestOfItsCategory) {
  write_text(file("in.graphml"), R"(<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
      <key id="x" for="node" attr.name="x" attr.type="double"/><key id="y" for="node" attr.name="y" attr.type="double"/>
      <key id="c" for="node" attr.name="category" attr.type="string"/>
      <key id="w" for="edge" attr.name="weight" attr.type="double"/><graph edgedefault="directed">
      <node id="n1"><data key="x">0</data><data key="y">0</data></node>
      <node id="n2"><data key="x">1</data><data key="y">0</data><data key="c">dock</data></node>
      <node id="n3"><data key="x">9</data><data key="y">0</data><data key="c">dock</data></node>
      <edge source="n1" target="n2"><data key="w">20</data></edge>
      <edge source="n1" target="n3"><data key="w">9</data></edge></graph></graphml>)");
  ASSERT_EQ(run_cairn({"map", "import", file("in.graphml"), "-o", map()}).exit_status, 0);
  EXPECT_EQ(from_to("L1", "nearest dock")["landmarks"], json({"L1", "L3"}));
  EXPECT_EQ(from_to("L1", "nearest dock", {"--avoid", "L3", "--close", "2"})["landmarks"], json({"L1", "L2"}));
  const json none = from_to("L1", "nearest dok");
  EXPECT_EQ(none["outcome"], "unknown_place");
  EXPECT_EQ(none["reason"], "no landmark of category \"dok\" (did you mean \"dock\"?); the map holds: dock");
}

TEST_F(GraphQueries, AFileOfQueriesTakesTheSameByItsKeys) {
  import(kHouse);
  const std::vector<json> all = answers(
      "{\"id\": 7, \"from\": \"L1\", \"to\": \"L5\", \"via\": [\"store\", \"L2\"]}\n\n"
      "{\"id\": \"a\", \"from\": \"L1\", \"to\": \"L3\", \"avoid\": \"hall\"}\r\n"
      "{\"from\": \"L1\", \"to\": \"L3\", \"closed\": [3, \"R9\"], \"alternatives\": 1, \"explain\": true}\n"
      "{\"from\": \"L1\", \"to\": \"L2\", \"cost\": \"time\", \"explain\": true}\n"
      "{\"from\": \"L5\", \"to\": \"L1\"}");
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[0]["id"], 7);
  EXPECT_EQ(all[0]["landmarks"], json({"L1", "L4", "L3", "L2", "L3", "L5"}));
  EXPECT_EQ(all[1]["id"], "a");
  EXPECT_EQ(all[1]["landmarks"], json({"L1", "L4", "L3"}));
  EXPECT_EQ(all[2]["cost_m"], 29.5);
  EXPECT_EQ(all[2]["alternatives"][0]["cost_m"], 35.0);
  EXPECT_EQ(all[2]["explanation"]["closed_on_cheaper_path"], json({3}));
  EXPECT_EQ(all[3]["explanation"]["cost_by"], "time");
  EXPECT_EQ(all[4]["outcome"], "no_route");
}

TEST_F(GraphQueries, OptionsHoldForTheLinesThatDoNotSayThemselves) {
  import(kHouse);
  const std::vector<json> all = answers(
      "{\"from\": \"L1\", \"to\": \"L3\"}\n{\"from\": \"L1\", \"to\": \"L3\", \"avoid\": [], \"explain\": false}\n",
      {"--avoid", "hall", "--explain"});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0]["cost_m"], 29.5);
  EXPECT_TRUE(all[0].contains("explanation"));
  EXPECT_EQ(all[1]["cost_m"], 20.0);
  EXPECT_FALSE(all[1].contains("explanation"));
}

TEST_F(GraphQueries, OverManyLandmarksTheExplanationReportsClustersAndLevels) {
  import(city(20, 3));
  const json answer = from_to("L1", "L400", {"--explain"});
  const json& explanation = answer["explanation"];
  const std::size_t levels = explanation["levels"];
  ASSERT_GE(levels, 1U);
  EXPECT_EQ(explanation["clusters"].size(), levels);
  EXPECT_EQ(explanation["settled_of_level"].size(), levels + 1);
  EXPECT_GT(explanation["clusters"][0].size(), 1U);
  EXPECT_EQ(explanation["search"], "Boost.Graph's A*");
  EXPECT_EQ(explanation["search_reason"], "400 landmarks, fewer than bidirectional_from (2000)");
  EXPECT_GE(explanation["search_level"], 1);
  std::int64_t settled = 0;
  for (const json& of_level : explanation["settled_of_level"]) settled += of_level.get<std::int64_t>();
  EXPECT_EQ(answer["settled"], settled);
  const std::string first = explanation["clusters"][0][0];
  EXPECT_THAT(first, testing::StartsWith("C1:L"));
  EXPECT_THAT(run({"--from", "L1", "--to", "L400", "--explain"}).out, HasSubstr("\n  level 1: " + first + ", "));
}

TEST_F(GraphQueries, TheExplanationSaysWhichSearchAnsweredAndFromWhereOnItIsAnother) {
  import(kHouse);
  EXPECT_THAT(run({"--from", "L1", "--to", "L3", "--explain"}).out,
              HasSubstr("\n  answered by Boost.Graph's A* on the landmark graph: "));
  const std::vector<std::string> other{"--explain", "--set", "graph.bidirectional_from=3"};
  const json answer = from_to("L1", "L3", other);
  EXPECT_EQ(answer["explanation"]["search"], "the search from both ends");
  EXPECT_EQ(answer["cost_m"], from_to("L1", "L3", {})["cost_m"]);
}

TEST_F(GraphQueries, ANamedClusterIsAvoidedWhole) {
  import(city(20, 3));
  const json before = from_to("L1", "L400", {"--explain"});
  const json& passed = before["explanation"]["clusters"][0];
  const std::string first = passed[0];
  std::string between;  // passed, and neither the start's nor the goal's
  for (const json& label : passed)
    if (label != first && label != passed.back()) between = label;
  ASSERT_NE(between, "");
  ASSERT_EQ(run_cairn({"map", "name", map(), between, "east wing"}).exit_status, 0);
  EXPECT_THAT(from_to("L1", "L400", {"--explain"})["explanation"]["clusters"][0], testing::Contains("east wing"));
  const json after = from_to("L1", "L400", {"--explain", "--avoid", "east wing"});
  EXPECT_EQ(after["outcome"], "solved");
  EXPECT_GE(after["cost_m"], before["cost_m"]);
  EXPECT_THAT(after["explanation"]["clusters"][0], Not(testing::Contains("east wing")));
  EXPECT_EQ(from_to("L1", "L400", {"--avoid", between})["landmarks"], after["landmarks"]);  // its own label holds too
  EXPECT_EQ(from_to("L1", "L400", {"--avoid", "east win"})["reason"],
            "there is no landmark and no cluster \"east win\" to avoid (did you mean \"east wing\"?)");
}

TEST_F(GraphQueries, FlatSearchFindsTheSameCosts) {
  for (const unsigned seed : {1U, 2U}) {
    import(city(22, seed));
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> any(1, 22 * 22);
    const auto landmark = [&] { return "L" + std::to_string(any(random)); };
    std::string queries;
    for (int i = 0; i < 60; ++i) {
      json query{{"id", i}, {"from", landmark()}, {"to", landmark()}};
      if (i % 3 == 1) query["avoid"] = {landmark(), landmark(), landmark()};
      if (i % 4 == 1) query["closed"] = {any(random), any(random)};
      if (i % 5 == 1) query["via"] = {landmark()};
      queries += query.dump() + "\n";
    }
    const std::vector<json> hybrid = answers(queries);
    const std::vector<json> flat = answers(queries, {"--planner", "flat_search"});
    ASSERT_EQ(hybrid.size(), 60U);
    ASSERT_EQ(flat.size(), 60U);
    for (std::size_t i = 0; i < flat.size(); ++i) {
      EXPECT_EQ(hybrid[i]["outcome"], flat[i]["outcome"]) << i;
      const double cost_m = flat[i]["cost_m"];
      EXPECT_NEAR(hybrid[i]["cost_m"], cost_m, 1e-9 * cost_m) << i;
    }
  }
}

}  // namespace
}  // namespace cairn::testing_program
