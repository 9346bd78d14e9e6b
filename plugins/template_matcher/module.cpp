#include "framework/contracts/module.hpp"

#include "plugins/template_matcher/template_matcher.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  using cairn::template_matcher::Config;
  using cairn::template_matcher::TemplateMatcher;
  registrar.add<cairn::Detector, Config>(
      "template_matcher", "matches landmark templates where the coarse grid says something new has been seen",
      [](const Config& config, const cairn::DetectorContext& context) {
        return std::make_unique<TemplateMatcher>(config, context.templates);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
