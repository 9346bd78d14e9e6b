// A sensor that may also implement this: one that can name what it is connected to, as the topics of a network. For
// people who look at a robot before it is driven (`cairn doctor live`).
#pragma once

#include <string>
#include <vector>

namespace cairn {

struct ConnectionValue {
  std::string name;  // "type"
  std::string text;  // "nav_msgs/msg/Odometry"
};

// A topic, a serial line.
struct ConnectionPart {
  std::string name;                     // "/odom"
  std::vector<ConnectionValue> values;  // in the order in which they are to be read
  std::string problem;                  // a sentence with what helps; empty: there is none
};

class ConnectionReport {
 public:
  virtual ~ConnectionReport() = default;
  // As known now, whether it is connected or not. By the thread of next(), between its calls. Nothing is sent to
  // wheels.
  [[nodiscard]] virtual std::vector<ConnectionPart> connection_parts() = 0;
};

}  // namespace cairn
