#include "framework/live/line_socket.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <filesystem>

#include "framework/live/wire.hpp"

namespace cairn::live {
namespace {

using testing::HasSubstr;

class ASocket : public testing::Test {
 protected:
  ASocket() { std::filesystem::create_directories(folder_); }
  ~ASocket() override { std::filesystem::remove_all(folder_); }

  static std::string reason_of(const std::function<void()>& call) {
    try {
      call();
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }
  static Descriptor accepted(const Descriptor& listening) {
    pollfd ready{listening.get(), POLLIN, 0};
    EXPECT_EQ(::poll(&ready, 1, 5000), 1);
    return Descriptor(::accept(listening.get(), nullptr, nullptr));
  }
  static void wait_for_text(const Descriptor& socket) {
    pollfd ready{socket.get(), POLLIN, 0};
    EXPECT_EQ(::poll(&ready, 1, 5000), 1);
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("cairn_lines_" + std::to_string(::getpid()));
  const Address address_{(folder_ / "base.sock").string(), {}, 0};
};

TEST_F(ASocket, AnAddressIsAPathOrAPort) {
  EXPECT_EQ(address_of("run/base.sock").socket, "run/base.sock");
  EXPECT_EQ(address_of("base.sock").socket, "base.sock");
  EXPECT_EQ(address_of("localhost:7531").port, 7531);
  EXPECT_EQ(text_of(address_of("localhost:7531")), "localhost:7531");
  EXPECT_EQ(reason_of([] { (void)address_of("localhost:0"); }), "localhost:0: a port is a number from 1 to 65535");
  EXPECT_EQ(reason_of([] { (void)address_of("localhost:many"); }),
            "localhost:many: a port is a number from 1 to 65535");
}

TEST_F(ASocket, OnlyTheUserMayConnectAndOnlyOneBaseListens) {
  {
    const Descriptor listening = listen_at(address_);
    struct stat found {};
    ASSERT_EQ(::stat(address_.socket.c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777U, 0600U);
    EXPECT_THAT(reason_of([&] { (void)listen_at(address_); }), HasSubstr("another process listens there"));
  }
  EXPECT_NO_THROW((void)listen_at(address_)) << "what a killed base has left is taken away";
}

TEST_F(ASocket, ABaseListensOnThisComputerOnly) {
  EXPECT_THAT(reason_of([] { (void)listen_at({{}, "0.0.0.0", 7531}); }), HasSubstr("on this computer only"));
  EXPECT_THAT(reason_of([] { (void)listen_at({{}, "example.org", 7531}); }), HasSubstr("an IPv4 address"));
  EXPECT_THAT(reason_of([] { (void)listen_at({std::string(200, 'x'), {}, 0}); }), HasSubstr("has at most 107 bytes"));
}

TEST_F(ASocket, NobodyThereIsSaidAtOnce) {
  std::string error;
  EXPECT_LT(connect_to(address_, error).get(), 0);
  EXPECT_EQ(error, "No such file or directory");
}

TEST_F(ASocket, LinesComeAsTheyWereSent) {
  const Descriptor listening = listen_at(address_);
  std::string error;
  const Descriptor client = connect_to(address_, error);
  ASSERT_GE(client.get(), 0) << error;
  const Descriptor base = accepted(listening);
  LineReader reader;
  EXPECT_TRUE(send_now(client.get(), "one\n\ntwo\r\nth"));
  wait_for_text(base);
  EXPECT_TRUE(reader.read(base.get()));
  EXPECT_EQ(reader.next(), "one");
  EXPECT_EQ(reader.next(), "two");
  EXPECT_EQ(reader.next(), std::nullopt);
  EXPECT_TRUE(send_now(client.get(), "ree\n"));
  wait_for_text(base);
  EXPECT_TRUE(reader.read(base.get()));
  EXPECT_EQ(reader.next(), "three");
}

TEST_F(ASocket, ALineBeyondAllLimitsEndsTheConnection) {
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends), 0);
  const Descriptor client(ends[0]);
  const Descriptor base(ends[1]);
  LineReader reader;
  const std::string much(65536, 'x');
  std::size_t sent = 0;
  bool is_there = true;
  while (is_there && sent < 3 * kMaxLineBytes) {
    if (send_now(client.get(), much)) sent += much.size();
    is_there = reader.read(base.get());
  }
  EXPECT_FALSE(is_there);
}

TEST_F(ASocket, WhoDoesNotReadMissesWholeLines) {
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends), 0);
  const Descriptor base(ends[0]);
  const Descriptor client(ends[1]);
  LineWriter writer;
  LineReader reader;
  const std::string line(5000, 'a');
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(writer.write(base.get(), line)) << "and is not waited for";
  int whole = 0;
  const auto read = [&] {
    EXPECT_TRUE(reader.read(client.get()));
    while (const auto got = reader.next()) {
      EXPECT_TRUE(*got == line || *got == "last");
      ++whole;
    }
  };
  read();
  EXPECT_TRUE(writer.write(base.get(), "last"));
  read();
  EXPECT_GT(whole, 1);
  EXPECT_LT(whole, 1000);
}

}  // namespace
}  // namespace cairn::live
