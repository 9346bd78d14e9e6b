#include "tests/fast_dds/stranger.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>
#include <thread>

namespace cairn::fast_dds {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr std::uint32_t kMaxBytes = 4U << 20U;
constexpr int kMaxParticipants = 8;

class RawType : public dds::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = kMaxBytes;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    if (bytes.size() > payload->max_size) return false;
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(payload->data, bytes.data(), bytes.size());
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    const char* begin = reinterpret_cast<const char*>(payload->data);
    static_cast<Bytes*>(data)->assign(begin, begin + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

template <class Qos>
void set(Qos& qos, const Offer& offer) {
  qos.reliability().kind = offer.is_reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = offer.is_latched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 10;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
}

class FastWriter : public Stranger::Writer {
 public:
  FastWriter(dds::Publisher* publisher, dds::DataWriter* writer) : publisher_(publisher), writer_(writer) {}
  ~FastWriter() override { publisher_->delete_datawriter(writer_); }
  void write(Bytes message) override { writer_->write(&message); }
  [[nodiscard]] bool is_matched() const override {
    dds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count > 0;
  }

 private:
  dds::Publisher* publisher_;
  dds::DataWriter* writer_;
};

class FastReader : public Stranger::Reader {
 public:
  FastReader(dds::Subscriber* subscriber, dds::DataReader* reader) : subscriber_(subscriber), reader_(reader) {}
  ~FastReader() override { subscriber_->delete_datareader(reader_); }
  std::vector<Bytes> take() override {
    std::vector<Bytes> all;
    Bytes message;
    for (dds::SampleInfo info; reader_->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK;)
      if (info.valid_data) all.push_back(message);
    return all;
  }
  [[nodiscard]] bool is_matched() const override {
    dds::SubscriptionMatchedStatus status;
    reader_->get_subscription_matched_status(status);
    return status.current_count > 0;
  }

 private:
  dds::Subscriber* subscriber_;
  dds::DataReader* reader_;
};

}  // namespace

struct Stranger::Parts {
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;

  dds::Topic* topic(const std::string& name, const std::string& type) const {
    if (auto* known = dynamic_cast<dds::Topic*>(participant->lookup_topicdescription("rt" + name))) return known;
    dds::TypeSupport(new RawType(type)).register_type(participant);
    return participant->create_topic("rt" + name, type, dds::TOPIC_QOS_DEFAULT);
  }
};

// As ROS does it with a white list of interfaces: UDP on 127.0.0.1, no multicast, no shared memory.
Stranger::Stranger(int domain) : parts_(std::make_unique<Parts>()) {
  dds::DomainParticipantQos qos;
  qos.transport().use_builtin_transports = false;
  const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.emplace_back("127.0.0.1");
  qos.transport().user_transports.push_back(udp);
  for (int i = 0; i < kMaxParticipants; ++i) {
    rtps::Locator_t peer;
    rtps::IPLocator::setIPv4(peer, 127, 0, 0, 1);
    peer.port = static_cast<std::uint32_t>(7400 + 250 * domain + 10 + 2 * i);
    qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  }
  parts_->participant =
      dds::DomainParticipantFactory::get_instance()->create_participant(static_cast<std::uint32_t>(domain), qos);
  if (parts_->participant == nullptr) throw std::runtime_error("Fast DDS makes no participant");
  parts_->publisher = parts_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  parts_->subscriber = parts_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
}

Stranger::~Stranger() {
  parts_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(parts_->participant);
}

std::unique_ptr<Stranger::Writer> Stranger::writer(const std::string& topic, const std::string& type, Offer offer) {
  dds::DataWriterQos qos;
  set(qos, offer);
  return std::make_unique<FastWriter>(parts_->publisher,
                                      parts_->publisher->create_datawriter(parts_->topic(topic, type), qos));
}

std::unique_ptr<Stranger::Reader> Stranger::reader(const std::string& topic, const std::string& type, Offer wish) {
  dds::DataReaderQos qos;
  set(qos, wish);
  return std::make_unique<FastReader>(parts_->subscriber,
                                      parts_->subscriber->create_datareader(parts_->topic(topic, type), qos));
}

Bytes written(const std::function<void(eprosima::fastcdr::Cdr&)>& write) {
  Bytes room(1U << 20U);
  eprosima::fastcdr::FastBuffer buffer(room.data(), room.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS, eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  write(cdr);
  room.resize(cdr.getSerializedDataLength());
  return room;
}

std::size_t read_all(Bytes message, const std::function<void(eprosima::fastcdr::Cdr&)>& read) {
  eprosima::fastcdr::FastBuffer buffer(message.data(), message.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::Cdr::DDS_CDR);
  cdr.read_encapsulation();
  read(cdr);
  const std::size_t padding = static_cast<unsigned char>(message[3]) & 3U;  // at the end, as the header says
  return message.size() - cdr.getSerializedDataLength() - padding;
}

int own_domain() {
  return 120 + static_cast<int>(::getpid() % 80);
}

bool comes_true(const std::function<bool()>& is_true, double within_s) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(within_s);
  for (; std::chrono::steady_clock::now() < until; std::this_thread::sleep_for(std::chrono::milliseconds(5)))
    if (is_true()) return true;
  return false;
}

}  // namespace cairn::fast_dds
