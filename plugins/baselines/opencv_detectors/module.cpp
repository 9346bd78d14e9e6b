#include "framework/contracts/module.hpp"

#include "plugins/baselines/opencv_detectors/chamfer.hpp"
#include "plugins/baselines/opencv_detectors/generalized_hough.hpp"
#include "plugins/baselines/opencv_detectors/match_template.hpp"

namespace {

using namespace cairn;
using namespace cairn::opencv_detectors;

template <class Made, class Config>
void add(Registrar& registrar, const char* name, const char* summary) {
  registrar.add<Detector, Config>(name, summary, [](const Config& config, const DetectorContext& context) {
    return std::make_unique<Made>(config, context.templates);
  });
}

void register_module(Registrar& registrar) {
  add<MatchTemplate, MatchTemplateConfig>(registrar, "match_template",
                                          "correlates landmark templates with the map by OpenCV's matchTemplate");
  add<Chamfer, ChamferConfig>(
      registrar, "chamfer",
      "holds the edges of landmark templates against those of the map by OpenCV's distanceTransform");
  add<GeneralizedHough, HoughConfig>(registrar, "generalized_hough",
                                     "lets pairs of edge points vote for landmarks by OpenCV's GeneralizedHoughGuil");
}

}  // namespace

CAIRN_MODULE(register_module)
