// What is said of a Pioneer's serial line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/p2os_robot/microcontroller.hpp"
#include "tests/plugins/p2os_robot/pioneer_on_a_terminal.hpp"

namespace cairn::p2os_robot {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string line_of(Microcontroller& robot) {
  const ConnectionPart part = robot.parts().at(0);
  std::string text = part.name + ": " + part.problem;
  for (const ConnectionValue& value : part.values) text += "; " + value.name + " " + value.text;
  return text;
}

TEST(SerialLine, IsDescribedWithTheRobotItsBatteryAndItsPackets) {
  PioneerOnATerminal pioneer;
  Config config;
  config.device = pioneer.device();
  RobotModel model;
  model.sonars.resize(16);
  Microcontroller robot(config, model);
  EXPECT_EQ(line_of(robot), pioneer.device() + ": ; baud 9600") << "nothing is known yet";
  std::string why;
  ASSERT_TRUE(robot.connect({}, why)) << why;
  std::vector<Observation> seen;
  while (seen.size() < 10) ASSERT_TRUE(robot.receive(seen));
  EXPECT_THAT(
      line_of(robot),
      AllOf(HasSubstr(": ; baud 9600; robot \"Robbi\"; class \"Pioneer\"; subclass \"p3dx-sh\"; battery 12.5 V; "
                      "packets "),
            HasSubstr(" a second; wrong checksums 0; age 0.")));
  pioneer.is_damaging = true;
  while (seen.size() < 30) ASSERT_TRUE(robot.receive(seen));
  EXPECT_THAT(line_of(robot), HasSubstr("many packets have a wrong checksum: is the cable sound"));
}

}  // namespace
}  // namespace cairn::p2os_robot
