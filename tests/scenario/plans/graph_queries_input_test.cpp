// What `cairn plan` says of questions that it cannot take.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class GraphQuestions : public testing::Test {
 protected:
  void SetUp() override {
    write_text(file("in.graph"), "node 1 0 0 entrance\nnode 2 10 0 hall\nedge 1 2 10\nedge 2 1 10\n");
    ASSERT_EQ(run_cairn({"map", "import", file("in.graph"), "-o", file("map.cairn")}).exit_status, 0);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] Finished run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"plan", file("map.cairn")});
    return run_cairn(arguments);
  }
  // Standard error of a query file that is refused, without "cairn: FOLDER/".
  [[nodiscard]] std::string refused(const std::string& queries, std::vector<std::string> more = {}) const {
    write_text(file("q.jsonl"), queries);
    more.insert(more.begin(), {"--queries", file("q.jsonl")});
    const Finished finished = run(more);
    EXPECT_EQ(finished.exit_status, 2) << finished.out;
    const std::string before = "cairn: " + folder_.string() + "/";
    EXPECT_THAT(finished.err, testing::StartsWith(before));
    return finished.err.substr(std::min(before.size(), finished.err.size()));
  }
  // The same of one query with this besides its ends.
  [[nodiscard]] std::string refused_key(const std::string& key) const {
    return refused(R"({"from": "L1", "to": "L2", )" + key + "}\n");
  }
  // Of a question that names what the map does not hold, or asks for what the planner does not do.
  [[nodiscard]] std::string refused(std::vector<std::string> arguments, const std::string& outcome) const {
    arguments.emplace_back("--json");
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.exit_status, 1) << finished.err;
    const json answer = json::parse(finished.out, nullptr, false);
    EXPECT_EQ(answer.value("outcome", ""), outcome) << finished.out;
    return answer.value("reason", "");
  }
  [[nodiscard]] std::string unknown(const std::vector<std::string>& arguments) const {
    return refused(arguments, "unknown_place");
  }
  [[nodiscard]] std::string unsupported(const std::vector<std::string>& arguments) const {
    return refused(arguments, "unsupported");
  }

  const std::filesystem::path folder_ = fresh_folder("graph_questions");
};

TEST_F(GraphQuestions, UnknownKeysAreRefusedWithTheNearest) {
  EXPECT_EQ(refused_key(R"("close": [1])"), "q.jsonl:1:28: a query knows no \"close\" (did you mean \"closed\"?)\n");
  EXPECT_EQ(refused_key(R"("alternative": 1)"),
            "q.jsonl:1:28: a query knows no \"alternative\" (did you mean \"alternatives\"?)\n");
  EXPECT_EQ(refused(R"({"from": "L1", "too": "L2"})"),
            "q.jsonl:1:16: a query knows no \"too\" (did you mean \"to\"?)\n");
  EXPECT_EQ(refused(R"({"id": 1, "from": "L1"})"), "q.jsonl:1:1: a query needs the text \"to\"\n");
  // Neither a text with quotes and brackets nor a key inside another value moves the place.
  EXPECT_EQ(refused(R"({"id": {"too": ["\"}", 1]}, "from": "L1", "to": "L2",  "vla": "L2"})"),
            "q.jsonl:1:56: a query knows no \"vla\" (did you mean \"via\"?)\n");
  EXPECT_EQ(refused(R"({"from": "L1", "to": "L2", "fr\u006fm": "L2"})"),
            "q.jsonl:1:28: the key \"from\" stands here twice\n");
}

TEST_F(GraphQuestions, DeepNestingIsRefused) {
  const auto nested = [](std::size_t depth) {
    return R"({"id": )" + std::string(depth, '[') + std::string(depth, ']') + R"(, "from": "L1", "to": "L2"})";
  };
  for (const std::size_t depth : {std::size_t{64}, std::size_t{400'000}})  // one bracket is the line's own
    EXPECT_EQ(refused(nested(depth)), "q.jsonl:1:71: nests deeper than 64 brackets\n");
  write_text(file("q.jsonl"), nested(63));
  EXPECT_EQ(run({"--queries", file("q.jsonl"), "--json"}).exit_status, 0);
  write_text(file("q.jsonl"), R"({"id": ")" + std::string(100, '[') + R"(\"[", "from": "L1", "to": "L2"})");
  EXPECT_EQ(run({"--queries", file("q.jsonl"), "--json"}).exit_status, 0);
}

TEST_F(GraphQuestions, WrongTypesAreRefused) {
  EXPECT_EQ(refused_key(R"("via": {"a": 1})"), "q.jsonl:1:35: \"via\" must be a list of names\n");
  EXPECT_EQ(refused_key(R"("avoid": [null])"), "q.jsonl:1:37: \"avoid\" must be a list of names\n");
  EXPECT_EQ(refused_key(R"("closed": 1.5)"), "q.jsonl:1:38: \"closed\" must be a list of names\n");
  EXPECT_EQ(refused_key(R"("explain": 1)"), "q.jsonl:1:39: \"explain\" must be true or false\n");
  EXPECT_EQ(refused_key(R"("cost": 3)"), "q.jsonl:1:36: \"cost\" must be a text\n");
  EXPECT_EQ(refused_key(R"("cost": "tim")"),
            "q.jsonl:1:36: cost \"tim\" is not length, time or clearance (did you mean \"time\"?)\n");
  for (const char* count : {"-1", "1.5", "1001", "\"3\"", "18446744073709551616"})
    EXPECT_EQ(refused_key(std::string("\"alternatives\": ") + count),
              "q.jsonl:1:44: \"alternatives\" must be a whole number of 0 to 1000\n");
  EXPECT_EQ(refused(R"({"from": 1, "to": "L2"})"), "q.jsonl:1:10: \"from\" must be a text\n");
}

TEST_F(GraphQuestions, ATourHasNoAlternatives) {
  const std::string reported = "alternatives are known from place to place, not for a tour\n";
  EXPECT_EQ(refused_key(R"("via": ["hall"], "alternatives": 1)"), "q.jsonl:1:61: " + reported);
  const Finished finished = run({"--from", "L1", "--to", "L2", "--via", "hall", "--alternatives", "1"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_EQ(finished.err, "cairn: " + reported);
}

TEST_F(GraphQuestions, ACutLineSaysWhereAndEarlierAnswersStay) {
  write_text(file("q.jsonl"), "{\"from\": \"L1\", \"to\": \"L2\"}\n{\"from\": \"L2\", \"to\": \"L");
  const Finished finished = run({"--queries", file("q.jsonl"), "--json"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_EQ(json::parse(finished.out, nullptr, false).value("outcome", ""), "solved");
  EXPECT_EQ(finished.err, "cairn: " + file("q.jsonl") +
                              ":2:24: expected one JSON object {\"id\", \"from\", \"to\"} a line; the line ends too "
                              "early\n");
  const std::string expected = "expected one JSON object {\"id\", \"from\", \"to\"} a line\n";
  EXPECT_EQ(refused("[1]"), "q.jsonl:1:1: " + expected);
  EXPECT_EQ(refused("hello"), "q.jsonl:1:1: " + expected);
  EXPECT_EQ(refused("{\"from\": \"L1\"}{}"), "q.jsonl:1:15: " + expected);
}

TEST_F(GraphQuestions, FilesOfQueriesThatAreNoneAreRefused) {
  const Finished none = run({"--queries", file("none.jsonl")});
  EXPECT_EQ(none.exit_status, 2);
  EXPECT_EQ(none.err, "cairn: " + file("none.jsonl") + ": no such file\n");
  const Finished folder = run({"--queries", folder_.string()});
  EXPECT_EQ(folder.exit_status, 2);
  EXPECT_EQ(folder.err, "cairn: " + folder_.string() + ": is a folder\n");
  const Finished empty = run({"--queries", "-", "--json"});  // standard input is empty here
  EXPECT_EQ(empty.exit_status, 2);
  EXPECT_EQ(empty.out, "");
  EXPECT_EQ(empty.err, "cairn: -: holds no query\n");
  EXPECT_EQ(refused("\n \n"), "q.jsonl: holds no query\n");
  EXPECT_EQ(run({"--from", "L1"}).err, "cairn: plan: give --from PLACE and --to PLACE, or --queries FILE\n");
}

TEST_F(GraphQuestions, WhatTheMapDoesNotHoldIsAnUnknownPlace) {
  const std::vector<std::string> ends{"--from", "L1", "--to", "L2"};
  const auto with = [&](const std::string& option, const std::string& value) {
    std::vector<std::string> arguments = ends;
    arguments.insert(arguments.end(), {option, value});
    return unknown(arguments);
  };
  EXPECT_EQ(with("--close", "77"), "the map has no route 77");
  EXPECT_EQ(with("--avoid", "hal"), "there is no landmark and no cluster \"hal\" to avoid (did you mean \"hall\"?)");
  EXPECT_THAT(with("--via", "hal"), HasSubstr("unknown place \"hal\" (did you mean \"hall\"?)"));
  EXPECT_THAT(unknown({"--from", "L1", "--to", "\xff"}), HasSubstr("unknown place"));  // no UTF-8, yet JSON comes out
  EXPECT_EQ(unsupported({"--from", "0,0", "--to", "L2"}),
            "the start is a pose, and a search over the landmark graph needs landmarks");
}

TEST_F(GraphQuestions, WhatIsAPlaceOnNoMapIsWrongUsage) {
  const auto reported = [&](const std::vector<std::string>& arguments) {
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.exit_status, 2) << finished.out;
    EXPECT_EQ(finished.out, "");
    return finished.err;
  };
  const std::string place =
      "; a place is x,y or x,y,angle_deg, a landmark's or cluster's id or name, `tag NUMBER`, or `nearest CATEGORY`\n";
  EXPECT_EQ(reported({"--from", "0.6", "--to", "1,1"}), "cairn: place \"0.6\" is one number" + place);
  EXPECT_EQ(reported({"--from", "L1", "--to", "1"}), "cairn: place \"1\" is one number (did you mean \"L1\"?)" + place);
  EXPECT_EQ(reported({"--from", "L1", "--to", "nan,1"}),
            "cairn: place \"nan,1\" has a number that is not finite" + place);
  EXPECT_EQ(reported({"--from", "L1", "--to", "L2", "--via", "1;2", "--json"}),
            "cairn: place \"1;2\" is not made of numbers alone" + place);
  EXPECT_EQ(reported({"--from", "L1", "--to", "L2", "--avoid", "1,2"}),
            "cairn: \"1,2\": only landmarks and clusters can be avoided\n");
  for (const std::string route : {"L1", "R", "1.5", "99999999999999999999999"})
    EXPECT_EQ(reported({"--from", "L1", "--to", "L2", "--close", route}),
              "cairn: route \"" + route + "\": a route is named by its number, as 12 or R12\n");
}

TEST_F(GraphQuestions, AWrongPlaceAmongManyQuestionsIsAnsweredAndTheRestToo) {
  write_text(file("q.jsonl"), R"({"id": 1, "from": "0.6", "to": "L2"})"
                              "\n"
                              R"({"id": 2, "from": "L1", "to": "L2"})");
  const Finished finished = run({"--queries", file("q.jsonl"), "--json"});
  EXPECT_EQ(finished.exit_status, 1) << finished.err;
  std::istringstream lines(finished.out);
  std::string line;
  std::getline(lines, line);
  const json first = json::parse(line, nullptr, false);
  EXPECT_EQ(first.value("id", 0), 1);
  EXPECT_EQ(first.value("outcome", ""), "unknown_place");
  EXPECT_THAT(first.value("reason", ""), testing::StartsWith("place \"0.6\" is one number"));
  std::getline(lines, line);
  EXPECT_EQ(json::parse(line, nullptr, false).value("outcome", ""), "solved");
}

TEST_F(GraphQuestions, WrongOptionsAreWrongUsage) {
  const auto wrong = [&](const std::string& option, const std::string& value) {
    const Finished finished = run({"--from", "L1", "--to", "L2", option, value});
    EXPECT_EQ(finished.exit_status, 2) << option;
    return finished.err;
  };
  EXPECT_THAT(wrong("--cost", "tim"), HasSubstr("--cost"));
  EXPECT_THAT(wrong("--alternatives", "-1"), HasSubstr("--alternatives"));
  EXPECT_THAT(wrong("--planner", "flat_serch"), HasSubstr("did you mean \"flat_search\"?"));
}

TEST_F(GraphQuestions, FlatSearchRefusesWhatItDoesNotKnow) {
  const std::vector<std::string> ends{"--from", "L1", "--to", "L2", "--planner", "flat_search"};
  const auto reported = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = ends;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return unsupported(arguments);
  };
  EXPECT_EQ(reported({"--explain"}), "flat_search does not know an explanation; landmark_search does");
  EXPECT_EQ(reported({"--alternatives", "2"}), "flat_search does not know alternatives; landmark_search does");
  EXPECT_EQ(reported({"--cost", "time"}), "flat_search does not know other costs than length; landmark_search does");
}

}  // namespace
}  // namespace cairn::testing_program
