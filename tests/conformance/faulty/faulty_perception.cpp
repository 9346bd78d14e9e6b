// Mappers, localizers, sensors and detectors that break their contracts.
#include "tests/conformance/detector.hpp"
#include "tests/conformance/faulty/faulty_modules.hpp"
#include "tests/conformance/localizer.hpp"
#include "tests/conformance/map.hpp"
#include "tests/conformance/sensor.hpp"

namespace cairn::conformance {
namespace {

class WrappedMapper : public Mapper {
 public:
  explicit WrappedMapper(std::shared_ptr<Mapper> inner) : inner_(std::move(inner)) {}
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    changes_ = inner_->integrate(observation, pose);
    return changes_;
  }
  [[nodiscard]] const OccupancyGrid& grid() const override { return inner_->grid(); }

 protected:
  std::shared_ptr<Mapper> inner_;
  CellChanges changes_;
};

class SilentMapper : public WrappedMapper {
 public:
  using WrappedMapper::WrappedMapper;
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    (void)WrappedMapper::integrate(observation, pose);
    if (!changes_.spans.empty()) changes_.spans.pop_back();
    return changes_;
  }
};

class UnsortedMapper : public WrappedMapper {
 public:
  using WrappedMapper::WrappedMapper;
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    (void)WrappedMapper::integrate(observation, pose);
    std::reverse(changes_.spans.begin(), changes_.spans.end());
    return changes_;
  }
};

class AllocatingMapper : public WrappedMapper {
 public:
  using WrappedMapper::WrappedMapper;
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    const std::vector<RangeReading> copy = observation.ranges;
    return copy.empty() ? changes_ : WrappedMapper::integrate(observation, pose);
  }
};

// Takes every reading for an echo, and a bad one for an error.
class TrustingMapper : public WrappedMapper {
 public:
  using WrappedMapper::WrappedMapper;
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    Observation seen = observation;
    for (RangeReading& reading : seen.ranges) {
      if (std::isnan(reading.range_m)) throw std::runtime_error("range is NaN");
      reading.range_m = std::min(reading.range_m, 0.5 * reading.max_m);
    }
    return WrappedMapper::integrate(seen, pose);
  }
};

Subject<Mapper> shipped_map() {
  return module<Mapper>(kModules, "bayes");
}
INSTANTIATE_TEST_SUITE_P(Faulty, MapperConformance,
                         testing::Values(wrapped<Mapper, SilentMapper>("forgets a span", shipped_map()),
                                         wrapped<Mapper, UnsortedMapper>("unsorted spans", shipped_map()),
                                         wrapped<Mapper, AllocatingMapper>("copies its input", shipped_map()),
                                         wrapped<Mapper, TrustingMapper>("trusts every range", shipped_map())));

class SureLocalizer : public Localizer {
 public:
  explicit SureLocalizer(const Pose2& T_map_start) : T_map_start_(T_map_start) {}
  PoseEstimate update(const Observation& observation, const KnownMap&) override {
    return {T_map_start_ * observation.T_odom_robot, 1e-4 * Eigen::Matrix3d::Identity()};
  }

 private:
  Pose2 T_map_start_;
};

class LopsidedLocalizer : public SureLocalizer {
 public:
  using SureLocalizer::SureLocalizer;
  PoseEstimate update(const Observation& observation, const KnownMap& known) override {
    PoseEstimate estimate = SureLocalizer::update(observation, known);
    estimate.covariance(0, 1) = 1e-2;
    return estimate;
  }
};

// What one object is given, all know.
class SharedLocalizer : public Localizer {
 public:
  explicit SharedLocalizer(const Pose2&) {}
  PoseEstimate update(const Observation& observation, const KnownMap&) override {
    static double travelled_m = 0.0;
    travelled_m += 0.1;
    return {{observation.T_odom_robot.x_m + travelled_m, 0.0, 0.0}, travelled_m * Eigen::Matrix3d::Identity()};
  }
};

template <class Type>
Subject<Localizer> localizer(const std::string& name) {
  return {name, [](const LocalizerContext& context) { return std::make_shared<Type>(context.T_map_start); }};
}
INSTANTIATE_TEST_SUITE_P(Faulty, LocalizerConformance,
                         testing::Values(localizer<SureLocalizer>("never in doubt"),
                                         localizer<LopsidedLocalizer>("lopsided covariance"),
                                         localizer<SharedLocalizer>("keeps its state in a static")));

// Small errors of a source around the simulated robot.
class WrappedSensor : public Sensor {
 public:
  explicit WrappedSensor(std::shared_ptr<Sensor> inner) : inner_(std::move(inner)) {}
  SensorStep next(const Budget& budget) override { return inner_->next(budget); }
  Drive* drive() override { return inner_->drive(); }

 protected:
  std::shared_ptr<Sensor> inner_;
};

class BackwardSensor : public WrappedSensor {
 public:
  using WrappedSensor::WrappedSensor;
  SensorStep next(const Budget& budget) override {
    SensorStep step = inner_->next(budget);
    if (++count_ % 7 == 0) step.observation.stamp_s -= 1.0;
    return step;
  }

 private:
  int count_ = 0;
};

class RestartingSensor : public WrappedSensor {
 public:
  using WrappedSensor::WrappedSensor;
  SensorStep next(const Budget& budget) override {
    if (++count_ % 20 == 0) return {};
    return inner_->next(budget);
  }

 private:
  int count_ = 0;
};

class UnboundedRangeSensor : public WrappedSensor {
 public:
  using WrappedSensor::WrappedSensor;
  SensorStep next(const Budget& budget) override {
    SensorStep step = inner_->next(budget);
    for (RangeReading& reading : step.observation.ranges)
      if (reading.range_m == kInfinity) reading.range_m = 1e4;
    return step;
  }
};

class RunawaySensor : public WrappedSensor, public Drive {
 public:
  using WrappedSensor::WrappedSensor;
  Drive* drive() override { return this; }
  void command(const Twist& twist, double valid_for_s) override {
    if (twist != Twist{}) inner_->drive()->command(twist, valid_for_s);
  }
  void stop() noexcept override {}
};

Subject<Sensor> shipped_robot() {
  return module<Sensor>(kModules, "simulated_robot");
}
INSTANTIATE_TEST_SUITE_P(Faulty, SensorConformance,
                         testing::Values(wrapped<Sensor, BackwardSensor>("time goes back", shipped_robot()),
                                         wrapped<Sensor, RestartingSensor>("ends and goes on", shipped_robot()),
                                         wrapped<Sensor, UnboundedRangeSensor>("no echo as 10 km", shipped_robot()),
                                         wrapped<Sensor, RunawaySensor>("does not stop", shipped_robot())));

class WrappedDetector : public Detector {
 public:
  explicit WrappedDetector(std::shared_ptr<Detector> inner) : inner_(std::move(inner)) {}
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) override {
    return inner_->detect(grid, changes, budget);
  }

 protected:
  std::shared_ptr<Detector> inner_;
};

class PercentDetector : public WrappedDetector {
 public:
  using WrappedDetector::WrappedDetector;
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) override {
    DetectionReport report = inner_->detect(grid, changes, budget);
    for (Matching& matching : report.matchings)
      for (CategoryDegree& degree : matching.degrees) degree.degree *= 100.0;
    return report;
  }
};

class RepeatingDetector : public WrappedDetector {
 public:
  using WrappedDetector::WrappedDetector;
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) override {
    DetectionReport report = inner_->detect(grid, changes, budget);
    if (report.matchings.empty()) return last_;
    last_ = report;
    return report;
  }

 private:
  DetectionReport last_;
};

class ThoroughDetector : public WrappedDetector {
 public:
  using WrappedDetector::WrappedDetector;
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget&) override {
    return inner_->detect(grid, changes, Budget{});
  }
};

Subject<Detector> shipped_detector() {
  return module<Detector>(kModules, "template_matcher");
}
INSTANTIATE_TEST_SUITE_P(Faulty, DetectorConformance,
                         testing::Values(wrapped<Detector, PercentDetector>("degrees in percent", shipped_detector()),
                                         wrapped<Detector, RepeatingDetector>("repeats itself", shipped_detector()),
                                         wrapped<Detector, ThoroughDetector>("ignores its budget",
                                                                             shipped_detector())));

}  // namespace
}  // namespace cairn::conformance
