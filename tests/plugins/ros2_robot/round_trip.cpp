// Messages through our types: ros2_round_trip DOMAIN < MESSAGES > MESSAGES. Each is its type's name and its bytes as on
// the wire, both with their count before them (32 bits, little endian); it is read as Cairn reads it, and out comes
// what Cairn would write, with its count: 0 where it was refused.
#include <dds/ddsi/ddsi_serdata.h>

#include <cstdint>
#include <cstring>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "plugins/ros2_robot/dds/endpoints.hpp"
#include "ros2.h"

namespace {

using cairn::ros2_robot::Entity;
using cairn::ros2_robot::Participant;

const std::map<std::string, const dds_topic_descriptor_t*>& types() {
  static const std::map<std::string, const dds_topic_descriptor_t*> all{
      {"std_msgs/Bool", &std_msgs_msg_dds__Bool__desc},
      {"geometry_msgs/PoseStamped", &geometry_msgs_msg_dds__PoseStamped__desc},
      {"geometry_msgs/PoseWithCovarianceStamped", &geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc},
      {"geometry_msgs/Twist", &geometry_msgs_msg_dds__Twist__desc},
      {"geometry_msgs/TwistStamped", &geometry_msgs_msg_dds__TwistStamped__desc},
      {"tf2_msgs/TFMessage", &tf2_msgs_msg_dds__TFMessage__desc},
      {"nav_msgs/Odometry", &nav_msgs_msg_dds__Odometry__desc},
      {"nav_msgs/OccupancyGrid", &nav_msgs_msg_dds__OccupancyGrid__desc},
      {"nav_msgs/Path", &nav_msgs_msg_dds__Path__desc},
      {"diagnostic_msgs/DiagnosticArray", &diagnostic_msgs_msg_dds__DiagnosticArray__desc},
      {"sensor_msgs/Range", &sensor_msgs_msg_dds__Range__desc},
      {"sensor_msgs/LaserScan", &sensor_msgs_msg_dds__LaserScan__desc},
      {"sensor_msgs/PointCloud", &sensor_msgs_msg_dds__PointCloud__desc},
      {"sensor_msgs/PointCloud2", &sensor_msgs_msg_dds__PointCloud2__desc},
      {"sensor_msgs/MagneticField", &sensor_msgs_msg_dds__MagneticField__desc},
      {"sensor_msgs/Imu", &sensor_msgs_msg_dds__Imu__desc},
      {"sensor_msgs/BatteryState", &sensor_msgs_msg_dds__BatteryState__desc},
      {"sensor_msgs/Image", &sensor_msgs_msg_dds__Image__desc},
      {"sensor_msgs/CompressedImage", &sensor_msgs_msg_dds__CompressedImage__desc},
      {"visualization_msgs/MarkerArray", &visualization_msgs_msg_dds__MarkerArray__desc},
  };
  return all;
}

class Type {
 public:
  // DDS hands out what it knows of a type with a message of it only.
  Type(const Participant& network, const std::string& name, const dds_topic_descriptor_t& descriptor)
      : descriptor_(descriptor),
        reader_(network.reader("/" + name, descriptor, cairn::ros2_robot::Reading::reliable)),
        writer_(network.writer("/" + name, descriptor)) {
    const Sample nothing(descriptor_);
    ddsi_serdata* serdata = nullptr;
    dds_sample_info_t info;
    if (dds_write(writer_.get(), nothing.get()) != DDS_RETCODE_OK ||
        dds_takecdr(reader_.get(), &serdata, 1, &info, DDS_ANY_STATE) != 1)
      throw std::runtime_error(name + ": nothing came");
    type_ = serdata->type;
    ddsi_serdata_unref(serdata);
  }

  [[nodiscard]] std::string passed_through(std::string bytes) const {
    ddsrt_iovec_t part{};
    part.iov_base = bytes.data();
    part.iov_len = bytes.size();
    ddsi_serdata* const read = ddsi_serdata_from_ser_iov(type_, SDK_DATA, 1, &part, bytes.size());
    if (read == nullptr) return {};
    const Sample sample(descriptor_);
    const bool is_read = ddsi_serdata_to_sample(read, sample.get(), nullptr, nullptr);
    ddsi_serdata_unref(read);
    if (!is_read) return {};
    ddsi_serdata* const written = ddsi_serdata_from_sample(type_, SDK_DATA, sample.get());
    if (written == nullptr) return {};
    std::string out(ddsi_serdata_size(written), '\0');
    ddsi_serdata_to_ser(written, 0, out.size(), out.data());
    ddsi_serdata_unref(written);
    return out;
  }

 private:
  class Sample {
   public:
    explicit Sample(const dds_topic_descriptor_t& descriptor)
        : descriptor_(descriptor), bytes_(std::memset(dds_alloc(descriptor.m_size), 0, descriptor.m_size)) {}
    ~Sample() { dds_sample_free(bytes_, &descriptor_, DDS_FREE_ALL); }
    Sample(const Sample&) = delete;
    Sample& operator=(const Sample&) = delete;
    [[nodiscard]] void* get() const { return bytes_; }

   private:
    const dds_topic_descriptor_t& descriptor_;
    void* bytes_;
  };

  const dds_topic_descriptor_t& descriptor_;
  Entity reader_;
  Entity writer_;
  const ddsi_sertype* type_ = nullptr;
};

bool read_counted(std::string& bytes) {
  std::uint32_t count = 0;
  if (!std::cin.read(reinterpret_cast<char*>(&count), sizeof count)) return false;
  bytes.resize(count);
  return static_cast<bool>(std::cin.read(bytes.data(), count));
}

void write_counted(const std::string& bytes) {
  const auto count = static_cast<std::uint32_t>(bytes.size());
  std::cout.write(reinterpret_cast<const char*>(&count), sizeof count);
  std::cout.write(bytes.data(), count);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  try {
    cairn::ros2_robot::NetworkChoice choice;
    choice.domain = std::stoi(arguments[1]);
    choice.is_local = true;
    const Participant network(choice);
    std::map<std::string, std::unique_ptr<Type>> known;
    for (std::string name, bytes; read_counted(name) && read_counted(bytes);) {
      if (!types().contains(name)) throw std::runtime_error(name + " is no topic's type");
      auto& type = known[name];
      if (!type) type = std::make_unique<Type>(network, name, *types().at(name));
      write_counted(type->passed_through(bytes));
    }
    return std::cout.flush() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
