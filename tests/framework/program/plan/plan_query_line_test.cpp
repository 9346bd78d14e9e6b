#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/config/config_value.hpp"
#include "framework/program/plan/plan_query.hpp"

namespace cairn {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

PlanQuery read(const std::string& line, const PlanQuestion& defaults = {}) {
  return query_of_line(line, "queries", 7, defaults);
}

// The error's sentence, once its place has been compared.
std::string error_at(int column, const std::string& line) {
  try {
    (void)read(line);
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.place().file, "queries");
    EXPECT_EQ(error.place().line, 7);
    EXPECT_EQ(error.place().column, column) << line;
    return error.sentence();
  }
  return "no error";
}

TEST(PlanQueryLine, HoldsAllThatAPlanMayBeAsked) {
  const PlanQuery query =
      read(R"({"id": 3, "from": "L1", "to": "nearest square", "avoid": ["L4", "C1:L7"], "closed": [2, "R9"],)"
           R"( "alternatives": 2, "cost": "time", "explain": true, "trajectory": true})");
  EXPECT_EQ(query.id, 3);
  EXPECT_EQ(query.question.from, "L1");
  EXPECT_EQ(query.question.to, "nearest square");
  EXPECT_THAT(query.question.avoid, ElementsAre("L4", "C1:L7"));
  EXPECT_THAT(query.question.closed, ElementsAre("2", "R9"));
  EXPECT_EQ(query.question.alternatives, 2);
  EXPECT_EQ(query.question.cost, "time");
  EXPECT_TRUE(query.question.explain);
  EXPECT_TRUE(query.question.trajectory);
}

TEST(PlanQueryLine, OneNameStandsForAListOfOne) {
  EXPECT_THAT(read(R"({"from": "L1", "to": "L2", "via": "L5"})").question.via, ElementsAre("L5"));
}

TEST(PlanQueryLine, AQuestionThatContradictsItselfIsRefused) {
  EXPECT_THAT(error_at(54, R"({"from": "a", "to": "b", "via": "c", "alternatives": 2})"), HasSubstr("not for a tour"));
}

TEST(PlanQueryLine, WhatItLeavesOutIsAsTheCommandLineHasIt) {
  PlanQuestion defaults;
  defaults.cost = "time";
  defaults.closed = {"R1"};
  const PlanQuery query = read(R"({"from": "L1", "to": "L2"})", defaults);
  EXPECT_EQ(query.id, "");
  EXPECT_EQ(query.question.cost, "time");
  EXPECT_THAT(query.question.closed, ElementsAre("R1"));
}

TEST(PlanQueryLine, AnUnknownKeyIsRefusedWhereItStandsWithTheNearestKnown) {
  EXPECT_THAT(error_at(15, R"({"from": "a", "fron": "b", "to": "c"})"),
              AllOf(HasSubstr("a query knows no \"fron\""), HasSubstr("\"from\"")));
}

TEST(PlanQueryLine, AKeyThatStandsTwiceIsRefusedWhereItStandsAgain) {
  EXPECT_THAT(error_at(15, R"({"from": "a", "from": "b", "to": "c"})"), HasSubstr("stands here twice"));
}

TEST(PlanQueryLine, AValueOfTheWrongTypeIsRefusedWhereItStands) {
  EXPECT_THAT(error_at(10, R"({"from": 1, "to": "c"})"), HasSubstr("\"from\" must be a text"));
  EXPECT_THAT(error_at(37, R"({"from": "a", "to": "b", "explain": 1})"), HasSubstr("must be true or false"));
  EXPECT_THAT(error_at(41, R"({"from": "a", "to": "b", "alternatives":-1})"), HasSubstr("whole number of 0 to 1000"));
}

TEST(PlanQueryLine, BothEndsMustBeGiven) {
  EXPECT_THAT(error_at(1, R"({"from": "a"})"), HasSubstr("a query needs the text \"to\""));
}

TEST(PlanQueryLine, WhatIsNoObjectIsRefused) {
  EXPECT_THAT(error_at(1, "[]"), HasSubstr("expected one JSON object"));
  EXPECT_THAT(error_at(15, R"({"from": "a", )"), HasSubstr("the line ends too early"));
  EXPECT_THAT(error_at(65, std::string(600, '[')), HasSubstr("nests deeper than 64 brackets"));
}

TEST(PlanQueryLine, NothingHidesBehindAZeroByte) {
  EXPECT_THAT(error_at(13, std::string("{\"from\": \"a\"\0, \"cost\": \"length\"}", 32)), HasSubstr("a zero byte"));
}

}  // namespace
}  // namespace cairn
