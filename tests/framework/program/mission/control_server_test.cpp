#include "framework/program/mission/control_server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace cairn {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class ControlServerTest : public testing::Test {
 protected:
  ControlServerTest() : control_(flags_, "held") {
    fs::create_directories(folder_);
    server_.emplace(folder_, control_);
    RunStatus status;
    status.mission = "held";
    status.state = RunState::running;
    control_.publish(status);
  }
  ~ControlServerTest() override {
    end();
    server_.reset();
    for (const int socket : crowd_) ::close(socket);
    fs::remove_all(folder_);
  }

  void end() {
    RunStatus status;
    status.mission = "held";
    status.state = RunState::ended;
    status.outcome = "cancelled";
    control_.publish(status);
  }
  void connect(int callers, const std::string& say = "") {
    for (int i = 0; i < callers; ++i) {
      sockaddr_un name{};
      name.sun_family = AF_UNIX;
      (folder_ / kControlSocket).string().copy(name.sun_path, sizeof name.sun_path - 1);
      crowd_.push_back(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
      ASSERT_EQ(::connect(crowd_.back(), reinterpret_cast<const sockaddr*>(&name), sizeof name), 0) << i;
      if (!say.empty()) (void)::send(crowd_.back(), say.data(), say.size(), MSG_NOSIGNAL);
    }
  }
  [[nodiscard]] json ask(const std::string& command) const { return json::parse(ask_mission(folder_, command).line); }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("cairn_control_" + std::to_string(::getpid()));
  ControlFlags flags_;
  RunControl control_;
  std::optional<ControlServer> server_;
  std::vector<int> crowd_;
};

TEST_F(ControlServerTest, ACrowdThatSaysNothingHoldsNobodyUp) {
  connect(400);
  EXPECT_EQ(ask("status")["mission"], "held");
  connect(100);
  const auto begin = std::chrono::steady_clock::now();
  std::thread mission([this] {
    while (!flags_.cancel) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    end();
  });
  EXPECT_EQ(ask("cancel")["outcome"], "cancelled");
  mission.join();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(1900))
      << "it waited until the silent ones were sent away";
}

TEST_F(ControlServerTest, ALinkAtItsPlaceIsReplacedAndNotFollowed) {
  const fs::path folder = folder_ / "linked";
  fs::create_directories(folder);
  fs::create_symlink(folder_ / kControlSocket, folder / kControlSocket);
  { const ControlServer other(folder, control_); }
  fs::create_symlink("nowhere", folder / kControlSocket);
  { const ControlServer other(folder, control_); }
  EXPECT_TRUE(fs::is_socket(fs::symlink_status(folder_ / kControlSocket)));
  EXPECT_EQ(ask("status")["mission"], "held");
}

TEST_F(ControlServerTest, WhatIsNoSocketIsLeftAloneAndNamed) {
  const fs::path folder = folder_ / "filed";
  fs::create_directories(folder / kControlSocket);
  try {
    const ControlServer other(folder, control_);
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), (folder / kControlSocket).string() + ": is no socket; remove it");
  }
  EXPECT_TRUE(fs::is_directory(folder / kControlSocket));
}

TEST_F(ControlServerTest, ACrowdThatSaysHalfALineHoldsNobodyUp) {
  connect(300, "canc");
  EXPECT_EQ(ask("status")["mission"], "held");
  EXPECT_FALSE(flags_.cancel);
}

TEST_F(ControlServerTest, AmongManyCommandsThatWaitACancelTakesEffectAtOnce) {
  connect(100, "pause\n");
  while (!flags_.pause) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const json answer = ask("cancel");
  EXPECT_EQ(answer["ok"], true);
  EXPECT_EQ(answer["mission"], "held");
  EXPECT_TRUE(flags_.cancel);
}

TEST_F(ControlServerTest, WhoSaysNothingIsSentAwayWithARule) {
  connect(1, "status");
  std::string line(1000, '\0');
  const ssize_t got = ::recv(crowd_.front(), line.data(), line.size(), 0);
  ASSERT_GT(got, 0);
  EXPECT_THAT(line, testing::HasSubstr("sent within 2 s"));
}

TEST_F(ControlServerTest, ACommandThatEndsWithTheConnectionIsACommand) {
  connect(1, "status");
  ASSERT_EQ(::shutdown(crowd_.front(), SHUT_WR), 0);
  const std::optional<std::string> line = read_line(crowd_.front(), 10'000, std::chrono::seconds(60));
  ASSERT_TRUE(line);
  EXPECT_EQ(json::parse(*line)["state"], "running");
}

}  // namespace
}  // namespace cairn
