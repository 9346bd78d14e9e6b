#include "plugins/baselines/opencv_detectors/config.hpp"

namespace cairn::opencv_detectors {
namespace {

template <class Config>
void describe_common(Fields<Config>& fields) {
  describe_templates(fields);
  fields.number("tau_match", &Config::tau_match, {0.0, 1.0}, "", "a template fits when its degree is above this");
}

template <class Config>
void describe_edges(Fields<Config>& fields) {
  fields.number("edge_low", &Config::edge_low, {0.0, 1140.0}, "OL",
                "Canny's lower threshold, on the magnitude of the Sobel gradient: an edge goes on down to this");
  fields.number("edge_high", &Config::edge_high, {0.0, 1140.0}, "OL",
                "Canny's upper threshold: an edge begins from here up");
}

}  // namespace

void MatchTemplateConfig::describe(Fields<MatchTemplateConfig>& fields) {
  describe_common(fields);
  fields.choice(
      "picture", &MatchTemplateConfig::picture,
      {{"gradients", Picture::gradients}, {"magnitude", Picture::magnitude}, {"occupancy", Picture::occupancy}},
      "what is correlated: both components of the gradient, its magnitude, or the occupancy itself, for which "
      "templates are drawn from the contour whatever the rendering");
  fields.flag("masked", &MatchTemplateConfig::masked,
              "only the template's own cells count, not the whole square about them");
}

void ChamferConfig::describe(Fields<ChamferConfig>& fields) {
  describe_common(fields);
  describe_edges(fields);
  fields.number("truncation_m", &ChamferConfig::truncation_m, {0.01, 10.0}, "m",
                "an edge point of the template further from every edge of the map counts as this far");
}

void HoughConfig::describe(Fields<HoughConfig>& fields) {
  describe_common(fields);
  describe_edges(fields);
  fields.angle("angle_tolerance_deg", &HoughConfig::angle_tolerance_rad, {0.1, 45.0},
               "gradients this near in direction count as the same");
  fields.number("bin_cells", &HoughConfig::bin_cells, {0.5, 20.0}, "cells",
                "votes are counted in squares of this side");
}

}  // namespace cairn::opencv_detectors
