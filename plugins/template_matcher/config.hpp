// Settings of the template matcher (docs/method.md 3 to 7). Values of OL and OL2 are on the scale 0..255.
#pragma once

#include "framework/files/template_settings.hpp"

namespace cairn::template_matcher {

enum class TriggerRule { since_matching, since_update, every_update };
enum class MismatchScale { sobel, literal };
enum class Search { pruned, exhaustive };
enum class Degrees { all, above_threshold, each_template };

struct Config : TemplateSettings {
  int coarse_cells = 5;
  double alpha_og2 = 2.0;
  double tau_trigger = 150.0;
  double tau_var = 16.0;
  double tau_again = 3.0;
  TriggerRule trigger = TriggerRule::since_matching;
  double tau_grow = 140.0;
  double tau_match = 0.6;
  MismatchScale mu = MismatchScale::sobel;
  double min_margin = 0.02;
  double min_above_unseen = 0.34;
  double hidden_degree = 0.5;
  double hidden_above = 0.54;
  bool between_cells = true;
  Degrees degrees = Degrees::all;
  Search search = Search::pruned;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::template_matcher
