// Saved maps that are served to several who ask: `cairn plan --serve`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <list>
#include <nlohmann/json.hpp>
#include <thread>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

// Keeps its connection.
class Asker {
 public:
  explicit Asker(const fs::path& file) : socket_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    file.string().copy(name.sun_path, sizeof name.sun_path - 1);
    is_connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&name), sizeof name) == 0;
  }
  ~Asker() { ::close(socket_); }
  Asker(const Asker&) = delete;
  Asker& operator=(const Asker&) = delete;

  [[nodiscard]] bool is_connected() const { return is_connected_; }
  void say(const std::string& text) const { (void)::send(socket_, text.data(), text.size(), MSG_NOSIGNAL); }
  // Discarded at the end of the connection.
  [[nodiscard]] json hear() const {
    std::string line;
    char c = 0;
    while (::recv(socket_, &c, 1, 0) == 1 && c != '\n') line += c;
    return json::parse(line, nullptr, false);
  }
  [[nodiscard]] json ask(const std::string& line) const {
    say(line + "\n");
    return hear();
  }

 private:
  int socket_;
  bool is_connected_ = false;
};

SavedMap room_of(int width) {
  SavedMap map;
  map.grid = OccupancyGrid(0.05);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < width; ++x)
      map.grid.set_log_odds({x, y}, x < 2 || x >= width - 2 || y < 2 || y >= 58 ? LogOdds{900} : LogOdds{-900});
  return map;
}

class ServedPlans : public testing::Test {
 protected:
  ServedPlans() {
    fs::create_directories(maps_);
    save_map((maps_ / "room.cairn").string(), room_of(60));
    save_map((maps_ / "hall.cairn").string(), room_of(200));
  }
  [[nodiscard]] std::vector<std::string> serving(const fs::path& what, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"plan", what.string(), "--serve", socket_.string()});
    return more;
  }

  const fs::path folder_ = fresh_folder("served_plans");
  const fs::path maps_ = folder_ / "maps";
  const fs::path socket_ = folder_ / "plans.sock";
};

constexpr const char* kInTheHall = R"({"id": 1, "map": "hall", "from": "0.5,0.5", "to": "9,2"})";

TEST_F(ServedPlans, AreThoseOfTheCommandLine) {
  Conversation server(serving(maps_));
  EXPECT_THAT(server.hear(), HasSubstr("are answered at " + socket_.string()));
  const Asker asker(socket_);
  json served = asker.ask(kInTheHall);
  json printed = json::parse(
      run_cairn({"plan", (maps_ / "hall.cairn").string(), "--from", "0.5,0.5", "--to", "9,2", "--json"}).out);
  EXPECT_EQ(served["outcome"], "solved");
  EXPECT_EQ(served["path"], printed["path"]);
  EXPECT_EQ(served["length_m"], printed["length_m"]);
  EXPECT_EQ(asker.ask(R"({"map": "room", "from": "0.5,0.5", "to": "9,2"})")["outcome"], "goal_blocked");
  server.send(SIGTERM);
  EXPECT_EQ(server.exit_status(), 0);
  EXPECT_FALSE(fs::exists(socket_));
}

TEST_F(ServedPlans, WhatIsNoQuestionIsToldAndTheNextIsAnswered) {
  Conversation server(serving(maps_));
  (void)server.hear();
  const Asker asker(socket_);
  const auto error_of = [&](const std::string& line) { return asker.ask(line).value("error", ""); };
  EXPECT_THAT(error_of("hello"), HasSubstr("query:1:"));
  EXPECT_THAT(error_of(R"({"from": "1,1"})"), HasSubstr("needs the text \"to\""));
  EXPECT_THAT(error_of(R"({"from": "1,1", "to": "2,2"})"), HasSubstr("which \"map\"? There are hall, room"));
  EXPECT_THAT(error_of(R"({"map": "hal", "from": "1,1", "to": "2,2"})"), HasSubstr("did you mean \"hall\"?"));
  EXPECT_THAT(error_of(R"({"map": "../maps/hall", "from": "1,1", "to": "2,2"})"), HasSubstr("no map"));
  EXPECT_THAT(error_of(R"({"mapp": "hall", "from": "1,1", "to": "2,2"})"), HasSubstr("did you mean \"map\"?"));
  EXPECT_EQ(asker.ask(R"({"id": "a", "form": "1,1"})")["id"], "a");
  EXPECT_EQ(asker.ask(kInTheHall)["outcome"], "solved");
  server.send(SIGINT);
  EXPECT_EQ(server.exit_status(), 0);
}

TEST_F(ServedPlans, AFileThatIsReplacedIsReadAgain) {
  Conversation server(serving(maps_ / "room.cairn"));
  (void)server.hear();
  const Asker asker(socket_);
  const std::string question = R"({"from": "0.5,0.5", "to": "9,2"})";
  EXPECT_EQ(asker.ask(question)["outcome"], "goal_blocked");
  save_map((maps_ / "room.cairn").string(), room_of(200));
  EXPECT_EQ(asker.ask(question)["outcome"], "solved");
  server.send(SIGTERM);
  EXPECT_EQ(server.exit_status(), 0);
}

TEST_F(ServedPlans, ManyAskAtOnceAndOneWhoIsSilentHoldsUpNobody) {
  Conversation server(serving(maps_, {"--jobs", "2"}));
  (void)server.hear();
  const Asker silent(socket_);
  silent.say("{\"from\"");
  std::vector<std::jthread> askers;
  std::atomic<int> solved = 0;
  for (int i = 0; i < 20; ++i)
    askers.emplace_back([&] {
      const Asker asker(socket_);
      for (int k = 0; k < 5; ++k)
        if (asker.ask(kInTheHall).value("outcome", "") == "solved") ++solved;
    });
  askers.clear();
  EXPECT_EQ(solved, 100);
  server.send(SIGTERM);
  EXPECT_EQ(server.exit_status(), 0);
}

TEST_F(ServedPlans, OneConnectionTooManyIsTurnedAway) {
  Conversation server(serving(maps_));
  (void)server.hear();
  std::list<Asker> crowd;
  for (int i = 0; i < 128; ++i) EXPECT_TRUE(crowd.emplace_back(socket_).is_connected());
  const Asker late(socket_);
  EXPECT_THAT(late.hear().value("error", ""), HasSubstr("too many connections"));
  crowd.pop_back();
  json answer = json::object();
  for (int i = 0; i < 100 && answer.value("outcome", "") != "solved"; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const Asker again(socket_);
    answer = again.ask(kInTheHall);
    if (!answer.is_object()) answer = json::object();
  }
  EXPECT_EQ(answer["outcome"], "solved");
  server.send(SIGTERM);
  EXPECT_EQ(server.exit_status(), 0);
}

TEST_F(ServedPlans, WhatCannotBeServedIsRefused) {
  const auto refused = [](const std::vector<std::string>& arguments) {
    const Finished finished = run_cairn(arguments);
    EXPECT_EQ(finished.exit_status, 2) << finished.out;
    return finished.err;
  };
  fs::create_directories(folder_ / "empty");
  EXPECT_THAT(refused(serving(folder_ / "empty")), HasSubstr("holds no saved map"));
  EXPECT_THAT(refused(serving(folder_ / "nowhere")), HasSubstr("nowhere: no such file"));
  EXPECT_THAT(refused(serving(maps_, {"--from", "1,1"})), HasSubstr("--serve"));
  EXPECT_THAT(refused({"plan", maps_.string(), "--serve", "0.0.0.0:4000"}), HasSubstr("on this computer only"));
  const fs::path queries = folder_ / "queries.jsonl";
  write_text(queries, "{\"map\": \"hall\", \"from\": \"1,1\", \"to\": \"2,2\"}\n");
  EXPECT_THAT(refused({"plan", (maps_ / "hall.cairn").string(), "--queries", queries.string()}),
              HasSubstr("queries.jsonl:1:1: \"map\" is for `cairn plan --serve`"));
}

}  // namespace
}  // namespace cairn::testing_program
