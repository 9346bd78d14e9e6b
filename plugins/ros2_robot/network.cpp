#include "plugins/ros2_robot/network.hpp"

#include <fmt/format.h>
#include <netdb.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr const char* kRange = "ROS_AUTOMATIC_DISCOVERY_RANGE";

[[noreturn]] void refuse(const char* variable, const std::string& value, const std::string& what) {
  throw std::invalid_argument(
      fmt::format("ros2_robot: the environment variable {} is {}: {}", variable, in_quotes(value), what));
}

// Asks the environment, and notes which variables had a say.
class Variables {
 public:
  Variables(const Environment& environment, std::vector<std::string>& said) : environment_(environment), said_(said) {}

  [[nodiscard]] std::string value_of(const char* variable) {
    std::string value = environment_(variable);
    if (!value.empty()) said_.push_back(fmt::format("{}={}", variable, value));
    return value;
  }

 private:
  const Environment& environment_;
  std::vector<std::string>& said_;
};

int domain_of(Variables& variables) {
  const std::string text = variables.value_of("ROS_DOMAIN_ID");
  if (text.empty()) return 0;
  const auto number = number_from<int>(text);
  if (!number || *number < kDomains.first || *number > kDomains.second)
    refuse("ROS_DOMAIN_ID", text,
           fmt::format("a domain is a number from {} to {}; the mission's setting `domain` goes before it",
                       kDomains.first, kDomains.second));
  return *number;
}

bool is_localhost_only(Variables& variables) {
  const std::string text = variables.value_of("ROS_LOCALHOST_ONLY");
  if (text.empty() || text == "0") return false;
  if (text != "1") refuse("ROS_LOCALHOST_ONLY", text, "it is 0 or 1; the mission's setting `network` goes before it");
  return true;
}

std::string range_of(Variables& variables) {
  std::string text = variables.value_of(kRange);
  if (text == "OFF")
    refuse(kRange, text, "no robot would be found; the mission's setting `network` (any, localhost) goes before it");
  const std::vector<std::string> known{"SUBNET", "LOCALHOST", "SYSTEM_DEFAULT"};
  if (!text.empty() && std::ranges::find(known, text) == known.end())
    refuse(kRange, text,
           "it is SUBNET, LOCALHOST, OFF or SYSTEM_DEFAULT" + did_you_mean(text, known) +
               "; the mission's setting `network` goes before it");
  return text;
}

std::vector<std::string> peers_of(Variables& variables) {
  const std::string text = variables.value_of("ROS_STATIC_PEERS");
  std::vector<std::string> peers;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    const std::string peer(trimmed(rest.substr(0, end)));
    if (!is_plain(peer) || peer.find_first_of(" ,") != std::string::npos)
      refuse("ROS_STATIC_PEERS", text, "addresses are separated by `;`, and " + in_quotes(peer) + " is none");
    if (!peer.empty()) peers.push_back(peer);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return peers;
}

}  // namespace

std::string process_environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

ChosenNetwork choose_network(const Config& config, const Environment& environment) {
  ChosenNetwork chosen;
  NetworkChoice& network = chosen.network;
  Variables variables(environment, chosen.variables);
  network.interface = config.interface;
  network.peers = config.peers;
  network.domain = config.domain == kDomainOfEnvironment ? domain_of(variables) : config.domain;
  bool asks_peers = true;
  if (config.network == Network::environment) {
    const bool is_local = is_localhost_only(variables);
    const std::string range = is_local ? "" : range_of(variables);
    network.is_without_multicast = is_local || range == "LOCALHOST";
    asks_peers = !is_local && range != "SYSTEM_DEFAULT";
  }
  if (network.peers.empty() && asks_peers) network.peers = peers_of(variables);
  if (config.network == Network::localhost)
    (network.peers.empty() ? network.is_local : network.is_without_multicast) = true;
  return chosen;
}

std::vector<std::string> unknown_peers(const NetworkChoice& network) {
  std::vector<std::string> unknown;
  std::ranges::copy_if(network.peers, std::back_inserter(unknown), [](const std::string& peer) {
    addrinfo* found = nullptr;
    const bool is_known = ::getaddrinfo(peer.c_str(), nullptr, nullptr, &found) == 0;
    if (is_known) ::freeaddrinfo(found);
    return !is_known;
  });
  return unknown;
}

}  // namespace cairn::ros2_robot
