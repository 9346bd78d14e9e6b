// Questions to an imported grid, one and many, as a user asks them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <sstream>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

class GridQueries : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937_64 random(5);
    std::string text = "type octile\nheight 40\nwidth 60\nmap\n";
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 60; ++x) text += random() % 5 == 0 ? '@' : '.';
      text += '\n';
    }
    write_text(file("rubble.map"), text);
    ASSERT_EQ(run_cairn({"map", "import", file("rubble.map"), "-o", file("map.cairn")}).exit_status, 0);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::vector<std::string> arguments(std::vector<std::string> more) const {
    more.insert(more.begin(), {"plan", file("map.cairn"), "--radius-m", "0"});
    return more;
  }
  [[nodiscard]] Finished run(const std::vector<std::string>& more) const { return run_cairn(arguments(more)); }
  [[nodiscard]] std::string refused(const std::vector<std::string>& more) const {
    const Finished finished = run(more);
    EXPECT_EQ(finished.exit_status, 2) << finished.out;
    EXPECT_THAT(finished.err, StartsWith("cairn: "));
    return finished.err.substr(std::min<std::size_t>(7, finished.err.size()));
  }
  // Between cell centres drawn by chance, so that some ends are blocked.
  static std::string queries(int count) {
    std::mt19937_64 random(9);
    const auto place = [&] { return std::to_string(random() % 60) + ".5," + std::to_string(random() % 40) + ".5"; };
    std::string text;
    for (int i = 0; i < count; ++i) text += json{{"id", i}, {"from", place()}, {"to", place()}}.dump() + "\n";
    return text;
  }
  [[nodiscard]] std::string asked(const std::string& text, const std::string& jobs, int exit_status,
                                  bool as_json = true) const {
    write_text(file("q.jsonl"), text);
    std::vector<std::string> more{"--queries", file("q.jsonl"), "--jobs", jobs};
    if (as_json) more.emplace_back("--json");
    const Finished finished = run(more);
    EXPECT_EQ(finished.exit_status, exit_status) << finished.err;
    return finished.out;
  }

  const std::filesystem::path folder_ = fresh_folder("grid_queries");
};

std::string without_times(const std::string& text) {
  static const std::regex times(R"re("time_ms":\{[^}]*\}|[0-9.]+ ms)re");
  return std::regex_replace(text, times, "TIME");
}

// 1200 x 1000 cells: rooms of 40 with a door in most walls, which paths must find.
std::string large_map() {
  constexpr int kRoom = 40;
  std::mt19937_64 random(6);
  std::vector<std::string> rows(1000, std::string(1200, '.'));
  for (int y = 0; y < 1000; ++y)
    for (int x = 0; x < 1200; ++x)
      if (x % kRoom == 0 || y % kRoom == 0) rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = '@';
  for (int y = kRoom; y < 1000; y += kRoom)
    for (int x = kRoom; x < 1200; x += kRoom) {
      const auto open = [&](int door_x, int door_y) {
        if (random() % 3 != 0) rows[static_cast<std::size_t>(door_y)][static_cast<std::size_t>(door_x)] = '.';
      };
      open(x, y - 1 - static_cast<int>(random() % 38));
      open(x - 1 - static_cast<int>(random() % 38), y);
    }
  std::string text = "type octile\nheight 1000\nwidth 1200\nmap\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

TEST_F(GridQueries, OneQuestionToALargeMapHasTheAnswerOfMany) {
  write_text(file("large.map"), large_map());
  ASSERT_EQ(run_cairn({"map", "import", file("large.map"), "-o", file("map.cairn")}).exit_status, 0);
  std::mt19937_64 random(7);
  std::string text;
  std::vector<json> questions;
  for (int i = 0; i < 8; ++i) {
    const int reach = i < 5 ? 150 : 900;
    const int x = 20 + static_cast<int>(random() % 250);
    const int y = 20 + static_cast<int>(random() % 80);
    const auto place = [](int at_x, int at_y) { return std::to_string(at_x) + ".5," + std::to_string(at_y) + ".5"; };
    questions.push_back(
        {{"id", i},
         {"from", place(x, y)},
         {"to", place(x + static_cast<int>(random() % reach), y + static_cast<int>(random() % reach))}});
    text += questions.back().dump() + "\n";
  }
  write_text(file("q.jsonl"), text);
  std::istringstream lines(run({"--queries", file("q.jsonl"), "--json"}).out);
  int solved = 0;
  std::string line;
  for (const json& question : questions) {
    ASSERT_TRUE(std::getline(lines, line));
    const json of_many = json::parse(line);
    const json alone = json::parse(run({"--from", question["from"], "--to", question["to"], "--json"}).out);
    EXPECT_EQ(alone["outcome"], of_many["outcome"]) << question;
    EXPECT_EQ(alone["reason"], of_many["reason"]);
    if (alone["outcome"] != "solved") continue;
    ++solved;
    EXPECT_NEAR(alone["length_m"].get<double>(), of_many["length_m"].get<double>(), 1e-6) << question;
    EXPECT_EQ(alone["path"].front(), of_many["path"].front());
  }
  EXPECT_GT(solved, 3);
}

TEST_F(GridQueries, AnswersAreTheSameAndInOrderHoweverManyAreWorkedOnAtOnce) {
  const std::string text = queries(60);
  const std::string one = asked(text, "1", 1);
  std::istringstream lines(one);
  int id = 0;
  int solved = 0;
  for (std::string line; std::getline(lines, line); ++id) {
    const json answer = json::parse(line, nullptr, false);
    EXPECT_EQ(answer["id"], id);
    solved += answer["outcome"] == "solved" ? 1 : 0;
  }
  EXPECT_EQ(id, 60);
  EXPECT_GT(solved, 20);
  EXPECT_LT(solved, 60);
  for (const char* jobs : {"2", "7"}) EXPECT_EQ(without_times(asked(text, jobs, 1)), without_times(one)) << jobs;
  EXPECT_EQ(without_times(asked(text, "1", 1, false)), without_times(asked(text, "7", 1, false)));
}

TEST_F(GridQueries, ABadLineComesAfterTheAnswersToAllBefore) {
  write_text(file("q.jsonl"), queries(50) + "{\"from\": \"1,1\", \"to\": \"2,2\", \"to\": \"3,3\"}\n" + queries(50));
  const Finished finished = run({"--queries", file("q.jsonl"), "--jobs", "4", "--json"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_EQ(finished.err, "cairn: " + file("q.jsonl") + ":51:30: the key \"to\" stands here twice\n");
  EXPECT_EQ(std::ranges::count(finished.out, '\n'), 50);
}

TEST_F(GridQueries, WhoAsksLineByLineIsAnsweredLineByLine) {
  for (const char* jobs : {"1", "3"}) {
    Conversation talk(arguments({"--queries", "-", "--jobs", jobs, "--json"}));
    for (int i = 0; i < 5; ++i) {
      talk.say(json{{"id", i}, {"from", "1.5,1.5"}, {"to", "30.5,20.5"}}.dump());
      EXPECT_EQ(json::parse(talk.hear(), nullptr, false).value("id", -1), i);
    }
    talk.say("nonsense");  // standard input stays open, and yet it ends
    EXPECT_EQ(talk.hear(), "");
    EXPECT_EQ(talk.exit_status(), 2);
  }
}

TEST_F(GridQueries, AnswersSayWhatThePathIsMadeOfWhenAsked) {
  const json plain = json::parse(run({"--from", "1.5,1.5", "--to", "30.5,20.5", "--json"}).out, nullptr, false);
  EXPECT_TRUE(plain.contains("length_lower_bound_m"));
  EXPECT_FALSE(plain.contains("segments"));
  const json explained =
      json::parse(run({"--from", "1.5,1.5", "--to", "30.5,20.5", "--json", "--explain"}).out, nullptr, false);
  ASSERT_TRUE(explained["segments"].is_array());
  for (const json& piece : explained["segments"]) {
    EXPECT_TRUE(piece["origin"].is_string());
    EXPECT_TRUE(piece["route"].is_number_integer());
    EXPECT_GE(piece["length_m"], 0.0);
  }
}

TEST_F(GridQueries, OptionsThatWouldBeIgnoredAreRefused) {
  write_text(file("q.jsonl"), queries(1));
  const std::vector<std::string> many{"--queries", file("q.jsonl")};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), many.begin(), many.end());
    return refused(more);
  };
  EXPECT_EQ(with({"--from", "1,1"}), "plan: --from is for one question; with --queries every line has its own\n");
  EXPECT_EQ(with({"--to", "1,1"}), "plan: --to is for one question; with --queries every line has its own\n");
  EXPECT_EQ(refused({"--from", "1,1", "--to", "2,2", "--jobs", "2"}),
            "plan: --jobs is for many questions; give it with --queries\n");
  EXPECT_THAT(run({"--queries", "-", "--jobs", "0"}).err, HasSubstr("--jobs"));
}

TEST_F(GridQueries, SettingsReachThePlannerAndItsParts) {
  const std::vector<std::string> ends{"--from", "1.5,1.5", "--to", "30.5,20.5"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), ends.begin(), ends.end());
    return more;
  };
  EXPECT_EQ(run(with({"--set", "route.algorithm=RRTConnect", "--set", "shortcut=false"})).exit_status, 0);
  EXPECT_EQ(run(with({"--planner", "ompl", "--set", "algorithm=RRTConnect"})).exit_status, 0);
  EXPECT_THAT(refused(with({"--set", "route.algorithm=RRTConect"})),
              StartsWith("--set route.algorithm: algorithm must be one of "));
  EXPECT_THAT(refused(with({"--set", "rout.algorithm=RRTConnect"})),
              StartsWith("--set rout.algorithm: unknown key \"rout\" in plugin hybrid (did you mean \"route\"?)"));
  EXPECT_EQ(refused(with({"--set", "shortcut"})), "--set: expected KEY=VALUE, found \"shortcut\"\n");
}

TEST_F(GridQueries, ARobotFileGivesTheFootprintAndTheRadiusOverridesIt) {
  write_text(file("big.yaml"), "name: big\nradius_m: 9\n");
  const std::vector<std::string> question{"plan", file("map.cairn"), "--from",  "1.5,1.5",
                                          "--to", "30.5,20.5",       "--robot", file("big.yaml")};
  EXPECT_THAT(run_cairn(question).out, HasSubstr("start_blocked"));
  std::vector<std::string> as_point = question;
  as_point.insert(as_point.end(), {"--radius-m", "0"});
  EXPECT_THAT(run_cairn(as_point).out, HasSubstr("solved"));
  EXPECT_EQ(refused({"--from", "1,1", "--to", "2,2", "--robot", file("none.yaml")}),
            file("none.yaml") + ": no such file\n");
}

}  // namespace
}  // namespace cairn::testing_program
