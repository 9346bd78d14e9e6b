// `cairn view` of a run: its stream, its steering, and what is left of it.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

// A `cairn view` and requests to it.
class ViewOfARun : public testing::Test {
 protected:
  ViewOfARun() {
    const std::string config = source_folder() + "/config/";
    write_text(folder_ / "world.yaml",
               "bounds_m: [[0, 0], [3, 3]]\nwalls: [{points_m: [[0, 0], [3, 0], [3, 3], [0, 3], [0, 0]]}]\n");
    write_text(folder_ / "mission.yaml", "mission: held\nrobot: " + config +
                                             "robots/pioneer1.yaml\nworld: world.yaml\n"
                                             "start: {at_m: [0.6, 0.6], angle_deg: 0}\n"
                                             "sensor: {plugin: simulated_robot}\n"
                                             "localizer: {plugin: odometry_compass}\n"
                                             "map: {plugin: muriel, cell_m: 0.05}\nsteps: [wait: 1000]\n");
  }
  ~ViewOfARun() override { fs::remove_all(folder_); }

  [[nodiscard]] std::vector<std::string> run_with(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"run", (folder_ / "mission.yaml").string(), "--out", out_.string(), "--pace",
                                       "10"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  void read_address(const Conversation& program) {
    std::string line = program.hear();
    while (!line.empty() && !line.starts_with("http://")) line = program.hear();
    const std::size_t port = line.rfind(':') + 1;
    host_ = line.substr(7, line.find('/', 7) - 7);
    port_ = static_cast<std::uint16_t>(std::stoi(line.substr(port)));
    token_ = line.substr(line.find("#t=") + 3);
  }
  // What comes back until the view closes, or so many bytes.
  [[nodiscard]] std::string ask(const std::string& first_line, const std::string& headers, const std::string& body,
                                std::size_t max_bytes = 1'000'000'000) const {
    const int client = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port_);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(client, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    const std::string sent = first_line + " HTTP/1.1\r\nHost: " + host_ + "\r\n" + headers +
                             "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
    (void)::send(client, sent.data(), sent.size(), MSG_NOSIGNAL);
    std::string answer;
    char piece[4096];
    for (ssize_t n = 0; answer.size() < max_bytes && (n = ::recv(client, piece, sizeof piece, 0)) > 0;)
      answer.append(piece, static_cast<std::size_t>(n));
    ::close(client);
    return answer;
  }
  [[nodiscard]] std::string get(const std::string& target) const {
    return ask("GET " + target, "X-Cairn-Token: " + token_ + "\r\n", "");
  }
  [[nodiscard]] std::string post(const std::string& target, const std::string& body) const {
    return ask("POST " + target, "Content-Type: application/json\r\nX-Cairn-Token: " + token_ + "\r\n", body);
  }
  static json body_of(const std::string& answer) { return json::parse(answer.substr(answer.find("\r\n\r\n") + 4)); }

  const fs::path folder_ = fresh_folder("view_of_a_run");
  const fs::path out_ = folder_ / "out";
  std::string host_;
  std::uint16_t port_ = 0;
  std::string token_;
};

TEST_F(ViewOfARun, OnlyWatchesUnlessItMaySteer) {
  Conversation run(run_with({"--view"}));
  read_address(run);
  EXPECT_EQ(body_of(get("/api/view")), (json{{"kind", "live"},
                                             {"control", false},
                                             {"edit", false},
                                             {"name", "out"},
                                             {"command", "cairn view '" + out_.string() + "'"}}));
  const std::string refused = post("/api/run/cancel", "{}");
  EXPECT_TRUE(refused.starts_with("HTTP/1.1 403")) << refused;
  EXPECT_THAT(refused, HasSubstr("--control"));
  EXPECT_TRUE(get("/api/run/cancel").starts_with("HTTP/1.1 405"));

  const std::string upgrade =
      "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n";
  const std::string protocol = "Sec-WebSocket-Protocol: cairn.view.1, token.";
  EXPECT_TRUE(ask("GET /live", upgrade, "").starts_with("HTTP/1.1 401"));
  EXPECT_TRUE(ask("GET /live", upgrade + protocol + std::string(32, 'a') + "\r\n", "").starts_with("HTTP/1.1 401"));
  EXPECT_TRUE(ask("GET /live", upgrade + protocol + token_ + "\r\nOrigin: http://evil.example\r\n", "")
                  .starts_with("HTTP/1.1 403"));
  const std::string stream = ask("GET /live", upgrade + protocol + token_ + "\r\n", "", 3000);
  EXPECT_TRUE(stream.starts_with("HTTP/1.1 101")) << stream;
  EXPECT_THAT(stream, HasSubstr("Sec-WebSocket-Protocol: cairn.view.1\r\n"));
  EXPECT_THAT(stream, HasSubstr(R"({"ok":true,"watch":1,"mission":"held")"));
  EXPECT_THAT(stream, HasSubstr(R"("afresh":true)"));

  const std::string foxglove = "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n";
  EXPECT_TRUE(ask("GET /?token=wrong", upgrade + foxglove, "").starts_with("HTTP/1.1 401"));
  const std::string viewed = ask("GET /?token=" + token_, upgrade + foxglove, "", 3000);
  EXPECT_TRUE(viewed.starts_with("HTTP/1.1 101")) << viewed;
  EXPECT_THAT(viewed, HasSubstr(R"("name":"cairn: out")"));
  EXPECT_THAT(viewed, HasSubstr(R"("topic":"/map")"));
  run.send(SIGTERM);
  EXPECT_EQ(run.exit_status(), 1);
}

TEST_F(ViewOfARun, SteersAsTheCommandLineDoes) {
  Conversation run(run_with({"--view", "--control"}));
  read_address(run);
  EXPECT_EQ(body_of(post("/api/run/pause", "{}"))["state"], "paused");
  EXPECT_EQ(body_of(post("/api/run/resume", "{}"))["state"], "running");
  const json order = body_of(post("/api/run/order", R"({"goto": [1, 2]})"));
  EXPECT_EQ(order["taken"], false);
  EXPECT_NE(order["reason"], "");
  EXPECT_TRUE(post("/api/run/order", R"({"gota": [1, 2]})").starts_with("HTTP/1.1 400"));
  EXPECT_TRUE(post("/api/run/status", "{}").starts_with("HTTP/1.1 404"));
  EXPECT_EQ(body_of(post("/api/run/cancel", "{}"))["outcome"], "cancelled");
  EXPECT_EQ(run.exit_status(), 1);
}

TEST_F(ViewOfARun, ChangesTheMapOnlyWhenItMayAndTheRunIsOver) {
  Conversation run(run_with({"--json"}));
  for (int i = 0; i < 2000 && !fs::exists(out_ / "control.sock"); ++i) ::usleep(5000);
  Conversation view({"view", out_.string(), "--edit", "--control"});
  read_address(view);
  const std::string capture = R"({"at": "0.6,0.6", "category": "box"})";
  EXPECT_TRUE(post("/api/edit/capture", capture).starts_with("HTTP/1.1 409"));
  EXPECT_EQ(body_of(post("/api/run/cancel", "{}"))["outcome"], "cancelled");
  EXPECT_EQ(run.exit_status(), 1);

  const std::string before = text_of_file(out_ / "held.cairn");
  const auto reason_of = [&](const std::string& what, const std::string& body) {
    const std::string answer = post("/api/edit/" + what, body);
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400")) << answer;
    return body_of(answer)["error"].get<std::string>();
  };
  EXPECT_THAT(reason_of("name", R"({"what": "L1", "name": "kitchen"})"), HasSubstr("L1"));
  EXPECT_THAT(reason_of("name", R"({"what": "L1", "nam": "kitchen"})"), HasSubstr(R"(did you mean "name")"));
  EXPECT_THAT(reason_of("close", R"({"route": "R1"})"), HasSubstr("no route 1"));
  EXPECT_THAT(reason_of("close", "[1, 2"), HasSubstr("JSON"));
  EXPECT_THAT(reason_of("capture", R"({"at": "0.6,0.6", "category": "../box"})"), HasSubstr("category"));
  EXPECT_THAT(reason_of("capture", capture), HasSubstr("held.cairn"));
  EXPECT_TRUE(post("/api/edit/burn", "{}").starts_with("HTTP/1.1 404"));
  EXPECT_TRUE(get("/api/edit/name").starts_with("HTTP/1.1 405"));
  EXPECT_EQ(text_of_file(out_ / "held.cairn"), before);
  view.send(SIGTERM);
  EXPECT_EQ(view.exit_status(), 0);

  Conversation watching({"view", out_.string()});
  read_address(watching);
  const std::string refused = post("/api/edit/capture", capture);
  EXPECT_TRUE(refused.starts_with("HTTP/1.1 403")) << refused;
  EXPECT_THAT(refused, HasSubstr("--edit"));
  watching.send(SIGTERM);
  EXPECT_EQ(watching.exit_status(), 0);
}

TEST_F(ViewOfARun, LeavesTheFileAloneThatARunStillWrites) {
  Conversation run(run_with({"--json"}));
  const fs::path autosaved = out_ / "held.autosave.cairn";
  for (int i = 0; i < 2000 && !(fs::exists(autosaved) && fs::exists(out_ / "control.sock")); ++i) ::usleep(5000);
  Conversation view({"view", autosaved.string(), "--edit"});
  read_address(view);
  const std::string capture = R"({"at": "0.6,0.6", "category": "box"})";
  const std::string refused = post("/api/edit/capture", capture);
  EXPECT_TRUE(refused.starts_with("HTTP/1.1 409")) << refused;
  EXPECT_THAT(refused, HasSubstr("a mission still writes the map"));
  run.send(SIGKILL);
  (void)run.exit_status();
  const std::string answered = post("/api/edit/capture", capture);
  EXPECT_TRUE(answered.starts_with("HTTP/1.1 400")) << answered;  // nothing stands there
  view.send(SIGTERM);
  EXPECT_EQ(view.exit_status(), 0);
}

TEST_F(ViewOfARun, OutlivesTheRunWhenItIsOnItsOwn) {
  Conversation run(run_with({"--json"}));
  for (int i = 0; i < 2000 && !fs::exists(out_ / "control.sock"); ++i) ::usleep(5000);
  Conversation view({"view", out_.string(), "--control"});
  read_address(view);
  EXPECT_EQ(body_of(get("/api/view"))["kind"], "live");
  double time_s = 0.0;
  for (int i = 0; i < 100 && time_s <= 0.0; ++i)
    time_s = json::parse(run_cairn({"mission", "status", out_.string(), "--json"}).out)["time_s"].get<double>();
  EXPECT_GT(time_s, 0.0);
  EXPECT_EQ(body_of(post("/api/run/cancel", "{}"))["outcome"], "cancelled");
  EXPECT_EQ(run.exit_status(), 1);
  EXPECT_EQ(body_of(get("/api/view"))["kind"], "run");
  EXPECT_EQ(body_of(get("/api/report"))["outcome"], "cancelled");
  EXPECT_FALSE(body_of(get("/api/track"))["poses"].empty());
  EXPECT_TRUE(body_of(get("/api/timing"))[0].contains("worst_us"));
  EXPECT_EQ(body_of(get("/api/map"))["name"], "held.cairn");
  EXPECT_TRUE(post("/api/run/pause", "{}").starts_with("HTTP/1.1 409"));
  view.send(SIGTERM);
  EXPECT_EQ(view.exit_status(), 0);
}

TEST_F(ViewOfARun, MakesNoDifferenceToTheMissionWhenItIsKilled) {
  const auto arguments = [&](const std::string& out) {
    return std::vector<std::string>{"run",    (folder_ / "mission.yaml").string(),
                                    "--set",  "steps=[explore: {at_most_s: 40}]",
                                    "--out",  (folder_ / out).string(),
                                    "--pace", "10"};
  };
  (void)run_cairn(arguments("alone"));
  Conversation run(arguments("out"));
  for (int i = 0; i < 2000 && !fs::exists(out_ / "control.sock"); ++i) ::usleep(5000);
  Conversation view({"view", out_.string()});
  read_address(view);
  const std::string stream = ask("GET /live",
                                 "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                                 "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n"
                                 "Sec-WebSocket-Protocol: cairn.view.1, token." +
                                     token_ + "\r\n",
                                 "", 3000);
  EXPECT_TRUE(stream.starts_with("HTTP/1.1 101")) << stream;
  ASSERT_TRUE(fs::exists(out_ / "control.sock")) << "the mission has ended before";
  view.send(SIGKILL);
  (void)view.exit_status();
  (void)run.exit_status();
  for (const char* file : {"held.cairn", "track.json"})
    EXPECT_EQ(text_of_file(out_ / file), text_of_file(folder_ / "alone" / file)) << file;
}

}  // namespace
}  // namespace cairn::testing_program
