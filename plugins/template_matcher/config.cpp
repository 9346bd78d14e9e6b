#include "plugins/template_matcher/config.hpp"

namespace cairn::template_matcher {

void Config::describe(Fields<Config>& fields) {
  describe_templates(fields);
  fields.integer("coarse_cells", &Config::coarse_cells, {1.0, 100.0},
                 "n: one OG2 cell covers n x n OG1 cells; at most the smallest landmark's diameter in cells");
  fields.number("alpha_og2", &Config::alpha_og2, {1.000001, 100.0}, "",
                "weight, in OG2's mean, of OG1 cells with OL > 127; the others weigh 1");
  fields.number("tau_trigger", &Config::tau_trigger, {0.0, 255.0}, "OL", "match only where OL2 is above this");
  fields.number("tau_var", &Config::tau_var, {0.0, 255.0}, "OL",
                "match again only where OL2 has risen by more than this");
  fields.number("tau_again", &Config::tau_again, {0.0, 255.0}, "OL",
                "where a template was above tau_match at the last matching, match again already when OL2 has changed, "
                "up or down, by more than this; 255: never, as in the paper");
  fields.choice(
      "trigger", &Config::trigger,
      {{"since_matching", TriggerRule::since_matching},
       {"since_update", TriggerRule::since_update},
       {"every_update", TriggerRule::every_update}},
      "what the rise is counted from: the last matching that covered the cell, or its last update; "
      "every_update is not a gate at all, to compare with: each update is matched where OL2 is above tau_grow");
  fields.number("tau_grow", &Config::tau_grow, {0.0, 255.0}, "OL",
                "the searched region grows over neighbours with OL2 above this");
  fields.number("tau_match", &Config::tau_match, {0.0, 1.0}, "", "a template fits when its degree is above this");
  fields.choice("mu", &Config::mu, {{"sobel", MismatchScale::sobel}, {"literal", MismatchScale::literal}},
                "the mismatch that counts as degree 0: the largest gradient, or the largest gradient difference");
  fields.number("min_margin", &Config::min_margin, {0.0, 1.0}, "",
                "the best category must lead the next one by this degree; 0 as in the paper");
  fields.number("min_above_unseen", &Config::min_above_unseen, {0.0, 1.0}, "",
                "the best template's degree d must reach this on the scale (d - u) / (1 - u), where u is its degree "
                "over unseen floor; 0 as in the paper");
  fields.number(
      "hidden_degree", &Config::hidden_degree, {0.0, 1.0}, "",
      "cells of an outline that cannot be seen, because another thing stands close behind it, count as fitting "
      "to this degree where they fit worse; 0: as the map shows them, as in the paper");
  fields.number("hidden_above", &Config::hidden_above, {0.0, 1.0}, "",
                "the same, where the whole outline fits to more than this degree");
  fields.flag("between_cells", &Config::between_cells,
              "compare categories, and place landmarks, between the cells and between the orientation steps; false: on "
              "them, as in the paper");
  fields.choice(
      "degrees", &Config::degrees,
      {{"all", Degrees::all}, {"above_threshold", Degrees::above_threshold}, {"each_template", Degrees::each_template}},
      "which degrees a matching reports: the best of every category, for the chart of a run; only those "
      "above tau_match, which is faster; or those of every template too, which is slower. Landmarks are "
      "the same");
  fields.choice("search", &Config::search, {{"pruned", Search::pruned}, {"exhaustive", Search::exhaustive}},
                "how the best places are found; the answers are the same");
}

}  // namespace cairn::template_matcher
