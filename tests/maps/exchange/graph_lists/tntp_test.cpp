#include "maps/exchange/graph_lists/tntp.hpp"

#include "tests/maps/exchange/exchange_fixture.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kHead =
    "<NUMBER OF NODES> 2\n<FIRST THRU NODE> 1\n<NUMBER OF LINKS> 1\n<END OF METADATA> \n\n~ heading ;\n";
const std::string kNodes = "Node\tX\tY\t;\n1\t0\t0\t;\n2 \t 300.5 \t -400 \t ; \n";

ImportedGraph parse(const std::string& net, const std::string& nodes = kNodes) {
  return parse_tntp({net, "net", nodes, "node"});
}

std::string refused(const std::string& net, const std::string& nodes = kNodes) {
  try {
    (void)parse(net, nodes);
  } catch (const ExchangeError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Tntp, LinksBecomeRoutesThatCostTheirLength) {
  const ImportedGraph read = parse(kHead + "\t1\t2\t25900.2\t6\t6\t0.15\t;\n");
  EXPECT_EQ(read.graph.find(2)->T_map_landmark.position(), Point(300.5, -400.0));
  ASSERT_EQ(read.graph.routes().size(), 1U);
  EXPECT_EQ(read.graph.find_route(1)->to, 2);
  EXPECT_EQ(read.graph.find_route(1)->cost_m, 6.0);
  EXPECT_THAT(read.warnings, IsEmpty());
}

TEST(Tntp, ZonesAreACategoryAndAWarning) {
  const ImportedGraph read = parse("<FIRST THRU NODE> 2\n<END OF METADATA>\n1 2 1 6 ;\n");
  EXPECT_EQ(read.graph.find(1)->category, "zone");
  EXPECT_EQ(read.graph.find(2)->category, "");
  EXPECT_THAT(read.warnings, ElementsAre("1 zone: nodes below the first through node, 2, are passed like others"));
}

TEST(Tntp, CoordinatesThatMayBeDegreesAreAWarning) {
  EXPECT_THAT(parse(kHead + "1 2 1 6 ;\n", "1 -96.7 43.6 ;\n2 -96.8 43.5 ;\n").warnings,
              ElementsAre(HasSubstr("may be degrees")));
}

TEST(Tntp, RefusesWithThePlace) {
  EXPECT_EQ(refused("1 2 3 4 ;\n"), "net:1:1: expected <KEY> VALUE or <END OF METADATA>, found \"1 2 3 4 ;\"");
  EXPECT_EQ(refused("<NUMBER OF LINKS> 1\n"), "net: has no <END OF METADATA>");
  EXPECT_EQ(refused(kHead + "1 3 1 6 ;\n"), "net:7:3: there is no node 3");
  EXPECT_EQ(refused(kHead + "1 2 1 -6 ;\n"), "net:7:7: the length must not be negative");
  EXPECT_EQ(refused(kHead), "net: <NUMBER OF LINKS> says 1, there are 0; the file may have been cut");
  EXPECT_EQ(refused(kHead + "1 2 1 6 ;\n", "1 0 0 ;\n1 2 3 ;\n"), "node:2:1: node 1 is there already, in line 1");
  EXPECT_EQ(refused(kHead + "1 2 1 6 ;\n", "Node X Y ;\n"), "node: holds no node (ID X Y ;)");
  EXPECT_EQ(refused(kHead + "1 2 1 6 ;\n", "Node X Y ;\nNode 1 2 ;\n"),
            "node:2:1: the node's id \"Node\" is not a whole number of 0 to 9007199254740991");
}

}  // namespace
}  // namespace cairn
