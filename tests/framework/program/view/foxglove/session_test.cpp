// Over a real connection: handshake, first frames, a subscription, and who is refused.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <future>
#include <nlohmann/json.hpp>
#include <thread>

#include "framework/program/view/foxglove/offer.hpp"
#include "framework/program/view/view_server.hpp"

namespace cairn {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kFoxgloveToken(32, 'f');

class FoxgloveClient {
 public:
  explicit FoxgloveClient(std::uint16_t port) : port_(port), socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    const timeval patience{20, 0};
    (void)::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  }
  ~FoxgloveClient() { ::close(socket_); }
  FoxgloveClient(const FoxgloveClient&) = delete;
  FoxgloveClient& operator=(const FoxgloveClient&) = delete;

  // The head of the answer.
  std::string shake_hands(const std::string& protocols, const std::string& target, const std::string& more = "") {
    send_all("GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) +
             "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: " +
             protocols + "\r\n" + more + "\r\n");
    std::string head;
    while (!head.ends_with("\r\n\r\n")) {
      const std::string byte = receive(1);
      if (byte.empty()) break;
      head += byte;
    }
    return head;
  }

  // The content of the next message, which may come in several frames.
  std::string message() {
    std::string whole;
    bool is_last = false;
    while (!is_last) {
      const std::string head = receive(2);
      if (head.size() < 2) return {};
      is_last = (static_cast<unsigned char>(head[0]) & 0x80U) != 0;
      whole += content(head);
    }
    return whole;
  }

  void send_text(const std::string& text) { send_frame('\x81', text); }
  void send_plan(char call) {
    send_frame('\x82', std::string("\2\1\0\0\0", 5) + std::string{call, 0, 0, 0, 4, 0, 0, 0} + "json{}");
  }

 private:
  // Short, with a mask of zeros.
  void send_frame(char kind, const std::string& content) {
    ASSERT_LT(content.size(), 126U);
    send_all(std::string{kind, static_cast<char>(0x80U | content.size())} + std::string(4, '\0') + content);
  }
  [[nodiscard]] std::string content(const std::string& head) const {
    std::uint64_t size = static_cast<unsigned char>(head[1]);
    const int more = size == 126 ? 2 : size == 127 ? 8 : 0;
    if (more > 0) {
      size = 0;
      for (const char c : receive(static_cast<std::size_t>(more))) size = size << 8U | static_cast<unsigned char>(c);
    }
    return receive(size);
  }
  void send_all(const std::string& bytes) const {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }
  [[nodiscard]] std::string receive(std::size_t count) const {
    std::string bytes(count, '\0');
    const ssize_t got = count == 0 ? 0 : ::recv(socket_, bytes.data(), count, MSG_WAITALL);
    bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
    return bytes;
  }

  std::uint16_t port_;
  int socket_;
};

class FoxgloveSessionTest : public testing::Test {
 protected:
  FoxgloveSessionTest() {
    auto recording = std::make_shared<PlayedRecording>();
    recording->name = "test";
    PlayedChannel channel;
    channel.channel = {1, "/a", "json", "S", "{}", "jsonschema"};
    channel.messages = {{1, "first"}, {2, std::string(3'000'000, 'x')}, {3, "last"}};
    recording->channels.push_back(std::move(channel));
    recording->times = {1, 3};
    FoxgloveServices services;
    services.plan = [this](const std::string&) {
      planned_.wait();
      return std::string("planned");
    };
    server_.offer_foxglove({[recording] { return recording; }, services, {"https://viewer.example"}});
    thread_ = std::thread([this] { server_.run(end_); });
  }
  ~FoxgloveSessionTest() override {
    end_ = true;
    thread_.join();
  }

  std::promise<void> may_plan_;
  const std::shared_future<void> planned_ = may_plan_.get_future().share();
  const std::string target_ = "/?token=" + kFoxgloveToken;
  std::atomic<bool> end_ = false;
  ViewServer server_{0, kFoxgloveToken, [](const ViewRequest&) { return ViewResponse{200, "text/plain", "page"}; }};
  std::thread thread_;
};

TEST_F(FoxgloveSessionTest, AnswersTheFirstNameThatItKnows) {
  const auto answer = [&](const std::string& names) {
    return FoxgloveClient(server_.port()).shake_hands(names, target_);
  };
  EXPECT_THAT(answer("foxglove.websocket.v1"), HasSubstr("Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n"));
  EXPECT_THAT(answer("foxglove.sdk.v1"), HasSubstr("Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n"));
  EXPECT_THAT(answer("other, foxglove.sdk.v1, foxglove.websocket.v1"),
              HasSubstr("Sec-WebSocket-Protocol: foxglove.sdk.v1\r\n"));
  EXPECT_THAT(answer("foxglove.sdk.v2"), Not(HasSubstr("101 Switching")));
}

TEST_F(FoxgloveSessionTest, SendsWhatItOffersAndThenTheMessages) {
  FoxgloveClient client(server_.port());
  EXPECT_THAT(client.shake_hands("foxglove.websocket.v1", target_), StartsWith("HTTP/1.1 101"));
  EXPECT_EQ(nlohmann::json::parse(client.message())["op"], "serverInfo");
  EXPECT_EQ(nlohmann::json::parse(client.message())["channels"][0]["topic"], "/a");
  EXPECT_EQ(nlohmann::json::parse(client.message())["op"], "advertiseServices");
  client.send_text(R"({"op":"subscribe","subscriptions":[{"id":5,"channelId":1}]})");
  std::vector<std::string> payloads;
  while (payloads.size() < 3) {
    const std::string message = client.message();
    ASSERT_FALSE(message.empty());
    if (message[0] == '\1') payloads.push_back(message.substr(13));
  }
  EXPECT_EQ(payloads[0], "first");
  EXPECT_TRUE(payloads[1] == std::string(3'000'000, 'x'));
  EXPECT_EQ(payloads[2], "last");
}

TEST_F(FoxgloveSessionTest, WhileAServiceIsCalledEverythingElseGoesOn) {
  FoxgloveClient asking(server_.port());
  EXPECT_THAT(asking.shake_hands("foxglove.websocket.v1", target_), StartsWith("HTTP/1.1 101"));
  for (int greeting = 0; greeting < 3; ++greeting) (void)asking.message();
  asking.send_plan(7);
  asking.send_text(R"({"op":"subscribe","subscriptions":[{"id":5,"channelId":1}]})");
  std::string message;
  do message = asking.message();
  while (!message.empty() && !(message[0] == '\1' && message.ends_with("last")));
  EXPECT_FALSE(message.empty()) << "its own messages";
  FoxgloveClient other(server_.port());
  EXPECT_THAT(other.shake_hands("foxglove.sdk.v1", target_), StartsWith("HTTP/1.1 101"));
  EXPECT_EQ(nlohmann::json::parse(other.message())["op"], "serverInfo");
  may_plan_.set_value();
  do message = asking.message();
  while (!message.empty() && message[0] != '\3');
  EXPECT_EQ(message.substr(0, 6), std::string("\3\1\0\0\0\7", 6));
  EXPECT_THAT(message, EndsWith("planned"));
}

TEST_F(FoxgloveSessionTest, StrangersAreRefused) {
  const auto answer = [&](const std::string& target, const std::string& header) {
    return FoxgloveClient(server_.port()).shake_hands("foxglove.sdk.v1", target, header);
  };
  EXPECT_THAT(answer("/", ""), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(answer("/?token=" + std::string(32, 'g'), ""), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(answer("/?token=" + kFoxgloveToken + "x", ""), StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(answer(target_, "Origin: https://evil.example\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer(target_, "Origin: https://viewer.example.evil\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answer(target_, "Origin: https://viewer.example\r\n"), StartsWith("HTTP/1.1 101"));
  EXPECT_THAT(answer("/?a=b&token=" + kFoxgloveToken, ""), StartsWith("HTTP/1.1 101"));
  EXPECT_THAT(answer(target_, "Host: evil.example\r\n"), StartsWith("HTTP/1.1 403")) << "two hosts";
}

TEST_F(FoxgloveSessionTest, AViewerThatIsGoneOrSilentLeavesTheOthersAlone) {
  FoxgloveClient silent(server_.port());
  EXPECT_THAT(silent.shake_hands("foxglove.sdk.v1", target_), StartsWith("HTTP/1.1 101"));
  silent.send_text(R"({"op":"subscribe","subscriptions":[{"id":5,"channelId":1}]})");
  {
    FoxgloveClient gone(server_.port());
    EXPECT_THAT(gone.shake_hands("foxglove.sdk.v1", target_), StartsWith("HTTP/1.1 101"));
  }
  FoxgloveClient other(server_.port());
  EXPECT_THAT(other.shake_hands("foxglove.sdk.v1", target_), StartsWith("HTTP/1.1 101"));
  EXPECT_EQ(nlohmann::json::parse(other.message())["op"], "serverInfo");
}

}  // namespace
}  // namespace cairn
