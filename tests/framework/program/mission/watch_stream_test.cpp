#include "framework/program/mission/watch_stream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <nlohmann/json.hpp>

#include "framework/program/mission/control_server.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::seconds;

// A mission that ticks until it is ended, and its control socket.
class WatchedRun : public testing::Test {
 protected:
  WatchedRun() : control_(flags_, "held") {
    fs::create_directories(folder_);
    grid_.set_log_odds({0, 0}, 400);
    server_.emplace(folder_, control_, Watching{&source_, R"({"ok":true,"mission":"held"})"});
    mission_ = std::thread([this] {
      const CellChanges changes{{{0, 0, 64}}};
      while (!has_ended_) {
        source_.on(TickDone{&changes}, {view_});
        ++ticks_;
        std::this_thread::yield();
      }
    });
  }
  ~WatchedRun() override {
    end();
    server_.reset();
    fs::remove_all(folder_);
  }

  void end() {
    if (!mission_.joinable()) return;
    has_ended_ = true;
    mission_.join();
    RunStatus status;
    status.mission = "held";
    status.state = RunState::ended;
    status.outcome = "done";
    control_.publish(status);
    source_.end(&grid_, graph_);
  }
  [[nodiscard]] Descriptor ask(const std::string& command) const {
    MissionConnection connection = connect_to_mission(folder_);
    EXPECT_EQ(connection.reached, Reached::answered);
    EXPECT_TRUE(write_line(connection.socket.get(), command));
    return std::move(connection.socket);
  }
  // Its lines until it ends, at most so many. What was read beyond them stays in `text`, for the next call.
  static std::vector<json> lines_of(const Descriptor& socket, std::size_t max, std::string& text) {
    std::vector<json> lines;
    char piece[4096];
    while (lines.size() < max) {
      if (const std::size_t end = text.find('\n'); end != std::string::npos) {
        lines.push_back(json::parse(text.substr(0, end)));
        text.erase(0, end + 1);
        continue;
      }
      const ssize_t got = ::recv(socket.get(), piece, sizeof piece, 0);
      if (got <= 0) break;
      text.append(piece, static_cast<std::size_t>(got));
    }
    return lines;
  }
  static std::vector<json> lines_of(const Descriptor& socket, std::size_t max) {
    std::string text;
    return lines_of(socket, max, text);
  }
  void wait_for_ticks(std::int64_t more) const {
    const std::int64_t until = ticks_ + more;
    while (ticks_ < until) std::this_thread::yield();
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("cairn_watch_" + std::to_string(::getpid()));
  ControlFlags flags_;
  RunControl control_;
  WatchSource source_;
  std::optional<ControlServer> server_;
  OccupancyGrid grid_{0.05};
  LandmarkGraph graph_;
  RobotModel robot_;
  WorldView view_{grid_, graph_, robot_, {}, 1.0};
  std::atomic<bool> has_ended_{false};
  std::atomic<std::int64_t> ticks_{0};
  std::thread mission_;
};

TEST_F(WatchedRun, TheConnectionBecomesAStreamThatEndsWithTheRun) {
  const Descriptor socket = ask(R"({"watch": {"every_ms": 1}})");
  std::string unread;
  const std::vector<json> lines = lines_of(socket, 5, unread);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0]["mission"], "held");
  EXPECT_EQ(lines[1]["afresh"], true);
  EXPECT_EQ(lines[1]["tiles"].size(), 1U);
  EXPECT_LT(lines[1]["tick"], lines[2]["tick"]);
  end();
  const std::vector<json> rest = lines_of(socket, 1'000'000, unread);
  ASSERT_FALSE(rest.empty());
  EXPECT_EQ(rest.back()["ended"], true);
  EXPECT_EQ(rest.back()["status"]["outcome"], "done");
}

TEST_F(WatchedRun, OneWhoReadsNothingHoldsNothingUp) {
  const Descriptor stalled = ask(R"({"watch": {"every_ms": 0}})");
  wait_for_ticks(20'000);
  const Descriptor other = ask("watch");
  EXPECT_EQ(lines_of(other, 3).size(), 3U);
  EXPECT_EQ(json::parse(ask_mission(folder_, "status").line)["ok"], true);
  end();
}

TEST_F(WatchedRun, OneWhoGoesIsForgotten) {
  for (std::size_t i = 0; i < 3 * kMaxWatches; ++i) {
    const Descriptor socket = ask("watch");
    std::vector<json> lines = lines_of(socket, 1);
    // The one before may not have been missed yet.
    if (lines.at(0)["ok"] == false) wait_for_ticks(10'000);
  }
  wait_for_ticks(10'000);
}

TEST_F(WatchedRun, OneTooManyIsRefused) {
  std::vector<Descriptor> watching;
  for (std::size_t i = 0; i < kMaxWatches; ++i) {
    watching.push_back(ask("watch"));
    EXPECT_EQ(lines_of(watching.back(), 1).at(0)["ok"], true);
  }
  const std::vector<json> lines = lines_of(ask("watch"), 2);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0]["error"], "already watched by 8");
}

TEST_F(WatchedRun, AWrongSettingIsNamed) {
  const auto error_of = [&](const std::string& command) {
    return lines_of(ask(command), 2).at(0)["error"].get<std::string>();
  };
  EXPECT_EQ(error_of(R"({"watch": {"every": 5}})"),
            "watch: unknown setting \"every\" (did you mean \"every_ms\"?); known is: every_ms");
  EXPECT_EQ(error_of(R"({"watch": {"every_ms": -1}})"), "watch: every_ms must be a whole number from 0 to 10000");
  EXPECT_EQ(error_of(R"({"watch": 5})"), R"(a watch is asked for as {"watch": {"every_ms": 50}})");
}

TEST_F(WatchedRun, ManyWhoReadNothingHoldUpItsEndNoLongerThanOne) {
  std::vector<Descriptor> stalled;
  while (stalled.size() < kMaxWatches) stalled.push_back(ask(R"({"watch": {"every_ms": 0}})"));
  std::this_thread::sleep_for(seconds(1));  // their sockets are full then
  end();
  const auto begin = std::chrono::steady_clock::now();
  server_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(2));
}

}  // namespace
}  // namespace cairn
