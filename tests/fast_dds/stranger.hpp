// A participant of a ROS 2 network that is not Cairn's: Fast DDS, on this computer only. It carries whole messages as
// bytes; what they mean is read and written by messages_by_hand.hpp.
#pragma once

#include <fastcdr/Cdr.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cairn::fast_dds {

struct Offer {
  bool is_reliable = true;
  bool is_latched = false;  // transient local
};

using Bytes = std::vector<char>;  // with the four that say how they are encoded

class Stranger {
 public:
  explicit Stranger(int domain);
  ~Stranger();
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  class Writer {
   public:
    virtual ~Writer() = default;
    virtual void write(Bytes message) = 0;
    [[nodiscard]] virtual bool is_matched() const = 0;
  };
  class Reader {
   public:
    virtual ~Reader() = default;
    [[nodiscard]] virtual std::vector<Bytes> take() = 0;
    [[nodiscard]] virtual bool is_matched() const = 0;
  };
  // topic: "/odom"; type: "nav_msgs::msg::dds_::Odometry_".
  [[nodiscard]] std::unique_ptr<Writer> writer(const std::string& topic, const std::string& type, Offer offer = {});
  [[nodiscard]] std::unique_ptr<Reader> reader(const std::string& topic, const std::string& type, Offer wish = {});

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// A message of what the call writes.
[[nodiscard]] Bytes written(const std::function<void(eprosima::fastcdr::Cdr&)>& write);
// Reads all of it; how many bytes are left is returned: 0 when the reader and the writer mean the same type.
std::size_t read_all(Bytes message, const std::function<void(eprosima::fastcdr::Cdr&)>& read);

// A domain of its own for each test program that runs.
[[nodiscard]] int own_domain();
[[nodiscard]] bool comes_true(const std::function<bool()>& is_true, double within_s = 10.0);

}  // namespace cairn::fast_dds
