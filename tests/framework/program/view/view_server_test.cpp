#include "framework/program/view/view_server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>
#include <vector>

namespace cairn {
namespace {

const std::string kToken(32, 'a');

class RunningServer {
 public:
  RunningServer() : thread_([this] { server_.run(end_); }) {}
  ~RunningServer() {
    end_ = true;
    thread_.join();
  }

  [[nodiscard]] int connect() const {
    const int client = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(server_.port());
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(client, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    return client;
  }
  // Everything that comes back until the server closes.
  std::string ask(const std::string& first_lines, const std::string& body = "") const {
    const int client = connect();
    const std::string sent = first_lines + "Host: 127.0.0.1:" + std::to_string(server_.port()) + "\r\n\r\n" + body;
    EXPECT_EQ(::send(client, sent.data(), sent.size(), MSG_NOSIGNAL), static_cast<ssize_t>(sent.size()));
    std::string answer;
    char piece[4096];
    for (ssize_t n = 0; (n = ::recv(client, piece, sizeof(piece), 0)) > 0;)
      answer.append(piece, static_cast<std::size_t>(n));
    ::close(client);
    return answer;
  }

 private:
  std::atomic<bool> end_ = false;
  ViewServer server_{0, kToken, [](const ViewRequest& request) {
                       if (request.target == "/api/fails") throw std::runtime_error("it fails");
                       return ViewResponse{200, "text/plain", request.target + request.body};
                     }};
  std::thread thread_;
};

TEST(ViewServer, AnswersWithAPolicyThatLetsNothingForeignIn) {
  const std::string answer = RunningServer().ask("GET / HTTP/1.1\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
  EXPECT_NE(answer.find("Content-Security-Policy: default-src 'self'"), std::string::npos) << answer;
  EXPECT_TRUE(answer.ends_with("\r\n\r\n/")) << answer;
}

TEST(ViewServer, HandsTheBodyOn) {
  const std::string answer = RunningServer().ask(
      "POST /api/plan HTTP/1.1\r\nContent-Type: application/json\r\n"
      "X-Cairn-Token: " +
          kToken + "\r\nContent-Length: 2\r\n",
      "{}");
  EXPECT_TRUE(answer.ends_with("\r\n\r\n/api/plan{}")) << answer;
}

TEST(ViewServer, RefusesWithoutTheToken) {
  EXPECT_TRUE(RunningServer().ask("GET /api/map HTTP/1.1\r\n").starts_with("HTTP/1.1 401"));
}

TEST(ViewServer, RefusesTwoHosts) {
  EXPECT_TRUE(RunningServer().ask("GET / HTTP/1.1\r\nHost: localhost\r\n").starts_with("HTTP/1.1 403"));
}

TEST(ViewServer, RefusesALongBodyBeforeItCame) {
  const std::string answer = RunningServer().ask("POST /api/plan HTTP/1.1\r\nContent-Length: 1048577\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 413")) << answer;
}

TEST(ViewServer, RefusesALongHeader) {
  const std::string answer = RunningServer().ask("GET / HTTP/1.1\r\nX: " + std::string(17000, 'x') + "\r\n");
  EXPECT_TRUE(answer.empty() || answer.starts_with("HTTP/1.1 431")) << answer;
}

TEST(ViewServer, AFailureIsAnAnswer) {
  const std::string answer = RunningServer().ask("GET /api/fails HTTP/1.1\r\nX-Cairn-Token: " + kToken + "\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 500")) << answer;
  EXPECT_NE(answer.find("it fails"), std::string::npos);
}

TEST(ViewServer, OneConnectionTooManyIsReported) {
  const RunningServer server;
  std::vector<int> idle;
  for (int i = 0; i < kMaxViewClients; ++i) idle.push_back(server.connect());
  EXPECT_TRUE(server.ask("GET / HTTP/1.1\r\n").starts_with("HTTP/1.1 429"));
  for (const int client : idle) ::close(client);
  std::string answer;
  for (int i = 0; i < 1000 && !answer.starts_with("HTTP/1.1 200"); ++i) answer = server.ask("GET / HTTP/1.1\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
}

TEST(ViewServer, OfAMapThereIsNoStream) {
  const std::string upgrade =
      "GET /live HTTP/1.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n";
  EXPECT_TRUE(RunningServer().ask(upgrade).starts_with("HTTP/1.1 401"));
  const std::string answer =
      RunningServer().ask(upgrade + "Sec-WebSocket-Protocol: cairn.view.1, token." + kToken + "\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 409")) << answer;
  EXPECT_TRUE(RunningServer()
                  .ask("GET /live HTTP/1.1\r\nSec-WebSocket-Protocol: token." + kToken + "\r\n")
                  .starts_with("HTTP/1.1 426"));
}

TEST(ViewServer, APortInUseIsReported) {
  const ViewServer first(0, kToken, [](const ViewRequest&) { return ViewResponse{}; });
  try {
    const ViewServer second(first.port(), kToken, [](const ViewRequest&) { return ViewResponse{}; });
    FAIL() << "listens twice on one port";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("view: cannot listen on 127.0.0.1:")) << error.what();
  }
}

}  // namespace
}  // namespace cairn
