// Settings of the detectors that OpenCV offers. Defaults, thresholds too, are the best of those tried on the
// sensed templates of config/templates in eight random worlds (docs/results/baselines.md).
#pragma once

#include "framework/files/template_settings.hpp"

namespace cairn::opencv_detectors {

// What all of them have.
struct CommonConfig : TemplateSettings {
  double tau_match = 0.0;
};

enum class Picture { gradients, magnitude, occupancy };

struct MatchTemplateConfig : CommonConfig {
  Picture picture = Picture::gradients;
  bool masked = true;
  MatchTemplateConfig() { tau_match = 0.75; }
  static void describe(Fields<MatchTemplateConfig>& fields);
};

struct ChamferConfig : CommonConfig {
  double edge_low = 250.0;
  double edge_high = 350.0;
  double truncation_m = 0.15;
  ChamferConfig() { tau_match = 0.79; }
  static void describe(Fields<ChamferConfig>& fields);
};

struct HoughConfig : CommonConfig {
  double edge_low = 200.0;
  double edge_high = 400.0;
  double angle_tolerance_rad = radians(30.0);
  double bin_cells = 3.0;
  HoughConfig() { tau_match = 0.054; }
  static void describe(Fields<HoughConfig>& fields);
};

}  // namespace cairn::opencv_detectors
