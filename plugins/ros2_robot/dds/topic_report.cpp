#include "plugins/ros2_robot/dds/topic_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr std::size_t kMaxName = 512;
constexpr std::ptrdiff_t kMaxTopicsListed = 8;

struct Own {
  std::string topic;
  std::string type;
  QosProfile profile;
};

// "1 in 3" of the same are one word.
std::string counted_texts(const std::map<std::string, int>& counts) {
  std::vector<std::string> texts;
  texts.reserve(counts.size());
  for (const auto& [text, count] : counts) texts.push_back(count == 1 ? text : fmt::format("{} x {}", count, text));
  return joined(texts, "; ");
}

Own own_of(const Entity& endpoint) {
  std::array<char, kMaxName> name{};
  std::array<char, kMaxName> type{};
  const dds_entity_t topic = dds_get_topic(endpoint.get());
  (void)dds_get_name(topic, name.data(), name.size());
  (void)dds_get_type_name(topic, type.data(), type.size());
  return {ros_name_of(name.data()), ros_type_of(type.data()), profile_of(endpoint.get())};
}

std::vector<Endpoint> those_of(const std::vector<Endpoint>& all, const std::string& topic) {
  std::vector<Endpoint> found;
  std::ranges::copy_if(all, std::back_inserter(found), [&](const Endpoint& one) { return one.topic == topic; });
  return found;
}

void add_types_and_qualities(const std::vector<Endpoint>& endpoints, const char* quality, ConnectionPart& part) {
  std::map<std::string, int> types;
  std::map<std::string, int> qualities;
  for (const Endpoint& endpoint : endpoints) {
    ++types[endpoint.type];
    ++qualities[text_of(endpoint.profile)];
  }
  if (endpoints.empty()) return;
  part.values.push_back({"type", counted_texts(types)});
  part.values.push_back({quality, counted_texts(qualities)});
}

}  // namespace

TopicReport::TopicReport(const Participant& participant, const ros::HeardTopics* heard, double now_s)
    : heard_(heard), now_s_(now_s), publishers_(participant.publishers()), subscribers_(participant.subscribers()) {}

ConnectionPart TopicReport::of_reader(const Entity& reader, Importance importance) const {
  const Own own = own_of(reader);
  const std::vector<Endpoint> offers = those_of(publishers_, own.topic);
  ConnectionPart part{own.topic, {}, {}};
  add_types_and_qualities(offers, "offered", part);
  if (offers.empty()) part.values.push_back({"type", own.type});
  part.values.push_back({"wanted", text_of(own.profile)});
  if (offers.empty()) {
    part.values.push_back({"published by", "nobody"});
    if (importance == Importance::optional) return part;
    std::set<std::string> names;
    for (const Endpoint& endpoint : publishers_) names.insert(endpoint.topic);
    part.problem =
        "nobody publishes it" + did_you_mean(own.topic, std::vector<std::string>(names.begin(), names.end()));
    return part;
  }
  if (heard_ != nullptr)
    std::ranges::move(heard_->values_of(own.topic, now_s_), std::back_inserter(part.values));
  else
    part.values.push_back({"heard", "not read before the odometry is there"});
  for (const Endpoint& offer : offers) {
    if (offer.type != own.type)
      part.problem = fmt::format("{} is published, and {} is read: see the topic's `type`", offer.type, own.type);
    else if (const std::string misfit = misfit_of(offer.profile, own.profile); !misfit.empty())
      part.problem = fmt::format("it does not fit, and nothing comes; {}", misfit);
  }
  if (part.problem.empty() && importance == Importance::steady && heard_ != nullptr &&
      heard_->find(own.topic) == nullptr)
    part.problem = "it is published, and nothing comes: does its driver run, and does a firewall let UDP through?";
  return part;
}

ConnectionPart TopicReport::of_velocities(const std::string& topic, const Entity& twist, const Entity& twist_stamped,
                                          bool has_guard) const {
  const std::vector<Endpoint> listeners = those_of(subscribers_, topic);
  ConnectionPart part{
      topic, {{"heard by", listeners.empty() ? "nobody" : counted(listeners.size(), "subscriber")}}, {}};
  add_types_and_qualities(listeners, "wanted", part);
  std::set<std::array<unsigned char, 16>> others;
  for (const Endpoint& other : those_of(publishers_, topic)) others.insert(other.participant);
  if (const std::size_t guards = has_guard ? 1 : 0; others.size() > guards)
    part.values.push_back({"also published by", counted(others.size() - guards, "participant")});
  std::string misfit;
  for (const Entity* const writer : {&twist, &twist_stamped}) {
    if (!*writer) continue;
    const Own own = own_of(*writer);
    for (const Endpoint& listener : listeners) {
      if (listener.type != own.type) continue;
      const std::string why = misfit_of(own.profile, listener.profile);
      if (why.empty()) return part;
      misfit = why;
    }
  }
  if (listeners.empty())
    part.problem = "no base listens to it: the robot would not move";
  else if (misfit.empty())
    part.problem = fmt::format("{} is wanted: set `command: {{type: auto}}`", listeners.front().type);
  else
    part.problem = "who listens does not fit, and hears nothing; " + misfit;
  return part;
}

ConnectionPart TopicReport::of_network(const std::string& name, const std::string& velocities) const {
  std::set<std::string> topics;
  for (const Endpoint& endpoint : publishers_)
    if (endpoint.topic.starts_with('/') && endpoint.topic != velocities) topics.insert(endpoint.topic);
  const std::ptrdiff_t listed = std::min(std::ssize(topics), kMaxTopicsListed);
  const std::vector<std::string> some(topics.begin(), std::next(topics.begin(), listed));
  ConnectionPart part{name, {{"published", topics.empty() ? "nothing" : joined(some)}}, {}};
  if (listed < std::ssize(topics)) part.values.back().text += fmt::format(" and {} more", std::ssize(topics) - listed);
  if (topics.empty()) part.problem = "nobody publishes anything: is ROS_DOMAIN_ID the same, and the network?";
  return part;
}

}  // namespace cairn::ros2_robot
