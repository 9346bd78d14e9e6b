#include "plugins/ros2_robot/dds/endpoints.hpp"

#include <algorithm>
#include <stdexcept>

namespace cairn::ros2_robot {
namespace {

constexpr int kMaxEndpoints = 512;
constexpr dds_duration_t kBlockFor = DDS_MSECS(20);

[[noreturn]] void fail(const std::string& what, dds_return_t error) {
  throw std::runtime_error(what + ": " + dds_strretcode(error));
}

Entity checked(dds_entity_t handle, const std::string& what) {
  if (handle < 0) fail(what, handle);
  return Entity(handle);
}

std::string plain(const std::string& text) {
  if (!is_plain(text)) throw std::runtime_error("\"" + text + "\" is no name or address");
  return text;
}

// Robots that are to keep to this computer may bind to the loopback, or not: both are met on two interfaces.
std::string interfaces_of(const NetworkChoice& network) {
  constexpr const char* kLoopback = "<NetworkInterface name=\"lo\" multicast=\"false\"/>";
  if (network.is_local) return kLoopback;
  const std::string own =
      network.interface.empty() ? "" : "<NetworkInterface name=\"" + plain(network.interface) + "\"/>";
  if (!network.is_without_multicast || network.interface == "lo") return own;
  return (own.empty() ? "<NetworkInterface autodetermine=\"true\"/>" : own) + kLoopback;
}

std::string settings_of(const NetworkChoice& network) {
  std::string general;
  const std::string interfaces = interfaces_of(network);
  if (!interfaces.empty()) general += "<Interfaces>" + interfaces + "</Interfaces>";
  const bool is_silent = network.is_local || network.is_without_multicast;
  if (is_silent) general += "<AllowMulticast>false</AllowMulticast>";
  std::vector<std::string> peers = network.peers;
  if (is_silent) peers.emplace_back("127.0.0.1");
  std::string discovery =
      "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>";
  if (!peers.empty()) {
    discovery += "<Peers>";
    for (const std::string& peer : peers) discovery += "<Peer Address=\"" + plain(peer) + "\"/>";
    discovery += "</Peers>";
  }
  return "<CycloneDDS><Domain><General>" + general + "</General><Discovery>" + discovery +
         "</Discovery></Domain></CycloneDDS>";
}

// "/scan" is the DDS topic "rt/scan".
std::string dds_name_of(const std::string& topic) {
  return "rt" + topic;
}

struct Qos {
  Qos() : qos(dds_create_qos()) {}
  ~Qos() { dds_delete_qos(qos); }
  Qos(const Qos&) = delete;
  Qos& operator=(const Qos&) = delete;
  dds_qos_t* qos;
};

}  // namespace

bool is_plain(const std::string& text) {
  return text.find_first_of("\"<&") == std::string::npos;
}

std::string ros_name_of(const std::string& topic) {
  return topic.starts_with("rt/") ? topic.substr(2) : topic;
}

std::string ros_type_of(std::string type) {
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"::dds_::", "::"}, {"::", "/"}})
    for (std::size_t at = type.find(from); at != std::string::npos; at = type.find(from, at + to.size()))
      type.replace(at, from.size(), to);
  if (type.ends_with('_')) type.pop_back();
  return type;
}

Participant::Participant(const NetworkChoice& network) {
  const auto domain = static_cast<dds_domainid_t>(network.domain);
  const dds_entity_t made = dds_create_domain(domain, settings_of(network).c_str());
  if (made > 0)
    domain_ = Entity(made);
  else if (made != DDS_RETCODE_PRECONDITION_NOT_MET)  // this process is in it already
    fail("ros2_robot: domain " + std::to_string(network.domain), made);
  const Qos qos;
  constexpr char kEnclave[] = "enclave=/;";  // without it ROS does not list the participant
  dds_qset_userdata(qos.qos, kEnclave, sizeof kEnclave - 1);
  participant_ = checked(dds_create_participant(domain, qos.qos, nullptr),
                         "ros2_robot: no participant in domain " + std::to_string(network.domain));
  publications_ = checked(dds_create_reader(participant_.get(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
                          "ros2_robot: no list of publishers");
  subscriptions_ = checked(dds_create_reader(participant_.get(), DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, nullptr, nullptr),
                           "ros2_robot: no list of subscribers");
}

Entity Participant::topic(const std::string& name, const dds_topic_descriptor_t& type) const {
  return checked(dds_create_topic(participant_.get(), &type, dds_name_of(name).c_str(), nullptr, nullptr),
                 "ros2_robot: topic " + name);
}

Entity Participant::reader(const std::string& name, const dds_topic_descriptor_t& type, Reading reading,
                           int kept) const {
  const Qos qos;
  if (reading == Reading::best_effort)
    dds_qset_reliability(qos.qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  else
    dds_qset_reliability(qos.qos, DDS_RELIABILITY_RELIABLE, kBlockFor);
  if (reading == Reading::latched) dds_qset_durability(qos.qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos.qos, DDS_HISTORY_KEEP_LAST, kept);
  Entity of = topic(name, type);
  return checked(dds_create_reader(participant_.get(), of.release(), qos.qos, nullptr),
                 "ros2_robot: no reader of " + name);
}

Entity Participant::writer(const std::string& name, const dds_topic_descriptor_t& type, Writing writing) const {
  const Qos qos;
  dds_qset_reliability(qos.qos, DDS_RELIABILITY_RELIABLE, kBlockFor);
  dds_qset_history(qos.qos, DDS_HISTORY_KEEP_LAST, 1);
  if (writing == Writing::latched) {
    dds_qset_durability(qos.qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_durability_service(qos.qos, 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED);
  }
  Entity of = topic(name, type);
  return checked(dds_create_writer(participant_.get(), of.release(), qos.qos, nullptr),
                 "ros2_robot: no writer of " + name);
}

bool is_read(const Entity& writer) {
  dds_publication_matched_status_t matched{};
  return writer && dds_get_publication_matched_status(writer.get(), &matched) == 0 && matched.current_count > 0;
}

std::vector<Endpoint> Participant::others(const Entity& builtin) const {
  void* samples[kMaxEndpoints] = {};
  dds_sample_info_t infos[kMaxEndpoints];
  const dds_return_t count = dds_read(builtin.get(), samples, infos, kMaxEndpoints, kMaxEndpoints);
  std::vector<Endpoint> all;
  dds_guid_t own{};
  (void)dds_get_guid(participant_.get(), &own);
  for (dds_return_t i = 0; i < count; ++i) {
    const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
    const bool is_alive = infos[i].instance_state == DDS_ALIVE_INSTANCE_STATE && infos[i].valid_data;
    if (!is_alive || std::equal(std::begin(own.v), std::end(own.v), std::begin(endpoint.participant_key.v))) continue;
    Endpoint& found = all.emplace_back(
        Endpoint{ros_name_of(endpoint.topic_name), ros_type_of(endpoint.type_name), profile_of(endpoint.qos), {}});
    std::copy(std::begin(endpoint.participant_key.v), std::end(endpoint.participant_key.v), found.participant.begin());
  }
  if (count > 0) dds_return_loan(builtin.get(), samples, count);
  return all;
}

}  // namespace cairn::ros2_robot
