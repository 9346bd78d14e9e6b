// Which network a robot is on, by settings and by ROS 2's variables of the environment; and who meets there.
#include "plugins/ros2_robot/network.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string_view>

namespace cairn::ros2_robot {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Variables = std::map<std::string, std::string>;

ChosenNetwork chosen(const Variables& variables, const Config& config = {}) {
  return choose_network(config, [&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? "" : found->second;
  });
}

std::string refusal(const Variables& variables) {
  try {
    (void)chosen(variables);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(RosNetwork, WithoutSettingsAndVariablesItIsDomain0OfAllComputers) {
  const ChosenNetwork open = chosen({});
  EXPECT_EQ(open.network.domain, 0);
  EXPECT_FALSE(open.network.is_local);
  EXPECT_FALSE(open.network.is_without_multicast);
  EXPECT_THAT(open.network.peers, IsEmpty());
  EXPECT_THAT(open.variables, IsEmpty());
}

TEST(RosNetwork, TheEnvironmentSaysWhatTheMissionLeavesOpen) {
  const ChosenNetwork said = chosen({{"ROS_DOMAIN_ID", "7"},
                                     {"ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"},
                                     {"ROS_STATIC_PEERS", "192.168.0.1; robot.local;"}});
  EXPECT_EQ(said.network.domain, 7);
  EXPECT_TRUE(said.network.is_without_multicast);
  EXPECT_THAT(said.network.peers, ElementsAre("192.168.0.1", "robot.local"));
  EXPECT_THAT(said.variables, ElementsAre("ROS_DOMAIN_ID=7", "ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST",
                                          "ROS_STATIC_PEERS=192.168.0.1; robot.local;"));
}

TEST(RosNetwork, ASettingGoesBeforeItsVariableEvenOneThatCannotBe) {
  Config config;
  config.domain = 0;
  config.network = Network::any;
  config.peers = {"10.0.0.1"};
  const ChosenNetwork set = chosen({{"ROS_DOMAIN_ID", "many"},
                                    {"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"},
                                    {"ROS_LOCALHOST_ONLY", "1"},
                                    {"ROS_STATIC_PEERS", "192.168.0.1"}},
                                   config);
  EXPECT_EQ(set.network.domain, 0);
  EXPECT_FALSE(set.network.is_without_multicast);
  EXPECT_THAT(set.network.peers, ElementsAre("10.0.0.1"));
  EXPECT_THAT(set.variables, IsEmpty());
}

TEST(RosNetwork, LocalhostOnlySilencesRangeAndPeersAsInRos) {
  const ChosenNetwork said = chosen(
      {{"ROS_LOCALHOST_ONLY", "1"}, {"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}, {"ROS_STATIC_PEERS", "192.168.0.1"}});
  EXPECT_TRUE(said.network.is_without_multicast);
  EXPECT_THAT(said.network.peers, IsEmpty());
  EXPECT_THAT(said.variables, ElementsAre("ROS_LOCALHOST_ONLY=1"));
  EXPECT_FALSE(chosen({{"ROS_LOCALHOST_ONLY", "0"}}).network.is_without_multicast);
}

TEST(RosNetwork, LocalhostIsTheLoopbackAloneUnlessThereArePeers) {
  Config config;
  config.network = Network::localhost;
  EXPECT_TRUE(chosen({}, config).network.is_local);
  config.peers = {"10.0.0.1"};
  EXPECT_FALSE(chosen({}, config).network.is_local);
  EXPECT_TRUE(chosen({}, config).network.is_without_multicast);
}

TEST(RosNetwork, AVariableThatCannotBeIsNamed) {
  EXPECT_THAT(refusal({{"ROS_DOMAIN_ID", "300"}}),
              HasSubstr("the environment variable ROS_DOMAIN_ID is \"300\": a domain is a number from 0 to 232; the "
                        "mission's setting `domain` goes before it"));
  EXPECT_THAT(refusal({{"ROS_DOMAIN_ID", "7a"}}), HasSubstr("ROS_DOMAIN_ID is \"7a\""));
  EXPECT_THAT(refusal({{"ROS_LOCALHOST_ONLY", "yes"}}), HasSubstr("ROS_LOCALHOST_ONLY is \"yes\": it is 0 or 1"));
  EXPECT_THAT(
      refusal({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNETS"}}),
      HasSubstr("it is SUBNET, LOCALHOST, OFF or SYSTEM_DEFAULT (did you mean \"SUBNET\"?); the mission's setting"));
  EXPECT_THAT(refusal({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}}), HasSubstr("no robot would be found"));
  EXPECT_THAT(refusal({{"ROS_STATIC_PEERS", "10.0.0.1,10.0.0.2"}}),
              AllOf(HasSubstr("ROS_STATIC_PEERS is"), HasSubstr("addresses are separated by `;`")));
}

TEST(RosNetwork, PeersThatNoNameServiceKnowsAreNamed) {
  NetworkChoice network;
  network.peers = {"127.0.0.1", "no-such-computer.invalid", "localhost"};
  EXPECT_THAT(unknown_peers(network), ElementsAre("no-such-computer.invalid"));
}

TEST(RosNetwork, SettingsAreReadFromTheMission) {
  const auto config = load_config<Config>(
      parse_config_text("{domain: 3, network: localhost, interface: eth7, peers: [10.0.0.1, robot.local]}", "test"),
      "ros2_robot");
  const NetworkChoice network = chosen({}, config).network;
  EXPECT_EQ(network.domain, 3);
  EXPECT_EQ(network.interface, "eth7");
  EXPECT_THAT(network.peers, ElementsAre("10.0.0.1", "robot.local"));
}

// Where a participant of the domain is asked for by its address.
int port_of(int domain) {
  return 7400 + 250 * domain + 10;
}

// A computer that is asked whether a participant is there: the address that the question came from, none within 1.5 s.
class AskedComputer {
 public:
  AskedComputer(const char* address, int domain) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    const timeval wait{1, 500000};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_port = htons(static_cast<std::uint16_t>(port_of(domain)));
    ::inet_pton(AF_INET, address, &here.sin_addr);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&here), sizeof here), 0);
  }
  AskedComputer(const AskedComputer&) = delete;
  AskedComputer& operator=(const AskedComputer&) = delete;
  ~AskedComputer() { ::close(socket_); }

  [[nodiscard]] std::string asked_from() const {
    std::array<char, 2048> packet{};
    sockaddr_in from{};
    socklen_t length = sizeof from;
    const auto bytes =
        ::recvfrom(socket_, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&from), &length);
    if (bytes < 4 || std::string_view(packet.data(), 4) != "RTPS") return "";
    std::array<char, INET_ADDRSTRLEN> text{};
    return ::inet_ntop(AF_INET, &from.sin_addr, text.data(), text.size());
  }

 private:
  int socket_;
};

// Two tests at once must not meet; a domain a participant, since a process has one configuration for each.
int next_domain() {
  static int next = 30 + static_cast<int>(::getpid() % 30);
  return next++;
}

TEST(RosNetwork, PeersAreAskedByWayOfTheInterface) {
  for (const bool is_without_multicast : {false, true}) {
    const int domain = next_domain();
    const AskedComputer peer("127.0.0.5", domain);
    const Participant asking({domain, false, "lo", {"127.0.0.5"}, is_without_multicast});
    EXPECT_EQ(peer.asked_from(), "127.0.0.1");
  }
}

TEST(RosNetwork, WhoIsNoPeerIsNotAsked) {
  const int domain = next_domain();
  const AskedComputer stranger("127.0.0.5", domain);
  const Participant asking({domain, false, "lo", {"127.0.0.6"}});
  EXPECT_EQ(stranger.asked_from(), "");
}

TEST(RosNetwork, PeersOfTheEnvironmentAreAsked) {
  const int domain = next_domain();
  const AskedComputer peer("127.0.0.5", domain);
  Config config;
  config.interface = "lo";
  const Participant asking(
      chosen({{"ROS_STATIC_PEERS", "127.0.0.6;127.0.0.5"}, {"ROS_DOMAIN_ID", std::to_string(domain)}}, config).network);
  EXPECT_EQ(peer.asked_from(), "127.0.0.1");
}

TEST(RosNetwork, AnInterfaceThatIsNotThereIsNamed) {
  try {
    const Participant none({next_domain(), false, "eth77", {}});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("ros2_robot: "));
  }
}

}  // namespace
}  // namespace cairn::ros2_robot
