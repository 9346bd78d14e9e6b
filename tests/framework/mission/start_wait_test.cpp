#include "framework/mission/start_wait.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "framework/contracts/optional/wait_report.hpp"

namespace cairn {
namespace {

class WaitingSensor : public Sensor, public WaitReport {
 public:
  explicit WaitingSensor(std::string sentence) : sentence_(std::move(sentence)) {}
  SensorStep next(const Budget&) override { return {}; }
  [[nodiscard]] std::string waits_for() const override {
    ++asked;
    return sentence_;
  }
  mutable std::atomic<int> asked{0};

 private:
  std::string sentence_;
};

TEST(StartWait, SaysWhatIsWaitedForAgainAndAgain) {
  const WaitingSensor sensor("waiting for a pose");
  std::promise<void> thrice;
  int said = 0;
  const StartWait wait(
      sensor,
      [&](const std::string& sentence) {
        EXPECT_EQ(sentence, "waiting for a pose");
        if (++said == 3) thrice.set_value();
      },
      std::chrono::milliseconds(1));
  thrice.get_future().wait();
}

TEST(StartWait, SaysItOnceUntilItsTimeHasPassedAgain) {
  const WaitingSensor sensor("waiting for a pose");
  std::promise<void> once;
  int said = 0;
  {
    const StartWait wait(sensor, [&](const std::string&) {
      if (++said == 1) once.set_value();
    });
    once.get_future().wait();
  }
  EXPECT_EQ(said, 1);
}

TEST(StartWait, WithoutAWaitNothingIsSaid) {
  const WaitingSensor sensor("");
  const StartWait wait(sensor, [](const std::string&) { FAIL(); });
  while (sensor.asked < 2) std::this_thread::yield();
}

}  // namespace
}  // namespace cairn
