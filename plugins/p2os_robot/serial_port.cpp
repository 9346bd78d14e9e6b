#include "plugins/p2os_robot/serial_port.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <stdexcept>

namespace cairn::p2os_robot {
namespace {

const std::map<int, speed_t>& speeds() {
  static const std::map<int, speed_t> kSpeeds{
      {9600, B9600}, {19200, B19200}, {38400, B38400}, {57600, B57600}, {115200, B115200}};
  return kSpeeds;
}

[[noreturn]] void fail(const std::filesystem::path& device, int error) {
  std::string why = std::strerror(error);
  if (error == ENOENT) why += ": is the cable plugged in? Adapters are /dev/ttyUSB0, ttyUSB1, ...";
  if (error == EACCES) why += ": your user may not use it; `sudo usermod -aG dialout $USER`, then log in again";
  if (error == ENOTTY) why = "is no serial line";
  if (error == EBUSY) why += ": another program drives the robot";
  throw std::runtime_error(device.string() + ": " + why);
}

}  // namespace

bool is_baud(int baud) {
  return speeds().contains(baud);
}

Descriptor open_serial_port(const std::filesystem::path& device, int baud) {
  Descriptor port(::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (port.get() < 0) fail(device, errno);
  termios line{};
  if (::tcgetattr(port.get(), &line) != 0) fail(device, errno);
  ::cfmakeraw(&line);
  line.c_cflag |= CLOCAL | CREAD;
  line.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  line.c_cc[VMIN] = 0;
  line.c_cc[VTIME] = 0;
  ::cfsetispeed(&line, speeds().at(baud));
  ::cfsetospeed(&line, speeds().at(baud));
  if (::tcsetattr(port.get(), TCSANOW, &line) != 0 || ::ioctl(port.get(), TIOCEXCL) != 0) fail(device, errno);
  ::tcflush(port.get(), TCIOFLUSH);
  return port;
}

bool write_now(int port, std::span<const std::uint8_t> bytes) noexcept {
  const ssize_t written = ::write(port, bytes.data(), bytes.size());
  return written == static_cast<ssize_t>(bytes.size());
}

}  // namespace cairn::p2os_robot
