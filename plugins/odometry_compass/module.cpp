#include "framework/contracts/module.hpp"

#include "plugins/odometry_compass/odometry_compass.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::odometry_compass::Config;
  using cairn::odometry_compass::OdometryCompass;
  registrar.add<cairn::Localizer, Config>(
      "odometry_compass", "Kalman filter over odometry, compass, walls and known landmarks, with a covariance",
      [](const Config& config, const cairn::LocalizerContext& context) {
        return std::make_unique<OdometryCompass>(config, context.robot, context.T_map_start, context.landmark_shapes,
                                                 context.start_uncertainty);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
