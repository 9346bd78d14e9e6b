#include "framework/contracts/module.hpp"

#include "plugins/april_tags/april_tags.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::april_tags::AprilTags;
  using cairn::april_tags::Config;
  registrar.add<cairn::MarkerDetector, Config>("april_tags", "finds AprilTags in the pictures of the robot's cameras",
                                               [](const Config& config, const cairn::ModuleContext& context) {
                                                 return std::make_unique<AprilTags>(config, context.robot.cameras);
                                               });
}

}  // namespace

CAIRN_MODULE(register_module)
