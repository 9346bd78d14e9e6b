#include "plugins/template_matcher/template_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace cairn::template_matcher {
namespace {

// The largest magnitude of a 3x3 Sobel gradient of values 0..255: components 1020 and 510.
const double kSobelMagnitude = 255.0 * std::sqrt(20.0);

int checked_coarse_cells(int coarse_cells, const TemplateSet& set) {
  const int most = static_cast<int>(std::floor(set.smallest_diameter_m() / set.cell_m + 1e-9));
  if (coarse_cells > most) {
    const auto smallest = std::ranges::min_element(
        set.shapes, {}, [](const LandmarkShape& shape) { return shape.contour.outer_diameter_m(); });
    std::ostringstream reason;
    reason << "the template \"" << smallest->category << "\" is " << smallest->contour.outer_diameter_m()
           << " m across, smaller than one cell of OG2, " << coarse_cells * set.cell_m << " m (" << coarse_cells
           << " cells); "
           << (most < 1 ? "it is smaller than a cell of the map too"
                        : "coarse_cells can be " + std::to_string(most) + " at most");
    throw std::invalid_argument(reason.str());
  }
  return coarse_cells;
}

// What keeps the class from being believed has at least this degree: see is_decided().
double least_degree(const ScoreRule& rule) {
  return std::max(0.0, rule.tau_match - rule.min_margin);
}

std::vector<std::int32_t> ceilings_of(double degree, double mu, std::span<const LandmarkTemplate> templates) {
  std::vector<std::int32_t> ceilings;
  ceilings.reserve(templates.size());
  for (const LandmarkTemplate& t : templates) ceilings.push_back(mismatch_ceiling(degree, t.scored_cells(), mu));
  return ceilings;
}

// Above this mismatch a template fits worse than the other one does, with their tolerances and without.
std::int32_t ceiling_beside(const TemplateMatch& other, const LandmarkTemplate& other_shape,
                            const LandmarkTemplate& shape) {
  if (other.mismatch == kUnmatched) return kUnmatched;
  const auto scaled = std::int64_t{other.mismatch} * static_cast<std::int64_t>(shape.scored_cells()) /
                      static_cast<std::int64_t>(other_shape.cells.size());
  return static_cast<std::int32_t>(std::min<std::int64_t>(scaled + 1, kUnmatched));
}

}  // namespace

TemplateMatcher::TemplateMatcher(const Config& config, std::shared_ptr<const TemplateSet> templates)
    : config_(config),
      templates_(usable(std::move(templates), "template_matcher")),
      rule_{config.mu == MismatchScale::sobel ? kSobelMagnitude : 2.0 * kSobelMagnitude, config.tau_match,
            config.min_margin, config.min_above_unseen},
      reach_(RegionReach::of(*templates_, config.coarse_cells * templates_->cell_m)),
      template_reach_(reach_of(templates_->templates)),
      coarse_(checked_coarse_cells(config.coarse_cells, *templates_), config.alpha_og2),
      trigger_(config),
      matcher_(templates_->templates),
      ceilings_(ceilings_of(least_degree(rule_), rule_.mu, templates_->templates)),
      hidden_ceilings_(
          ceilings_of(config.hidden_degree > 0.0 ? config.hidden_above : 1.0, rule_.mu, templates_->templates)),
      hidden_(templates_->templates,
              static_cast<int>(std::ceil(2.0 * templates_->largest_diameter_m() / templates_->cell_m))),
      neighbours_(*templates_) {}

DetectionReport TemplateMatcher::detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) {
  check_cell_size(*templates_, grid.cell_m());
  DetectionReport report;
  coarse_.update(grid, changes, touched_);
  trigger_.begin_update();
  for (const Cell coarse : touched_) {
    if (static_cast<std::int64_t>(report.matchings.size()) >= budget.iterations || budget.exhausted()) break;
    if (trigger_.fires(coarse, coarse_.ol(coarse))) report.matchings.push_back(match(grid, coarse));
  }
  return report;
}

Matching TemplateMatcher::match(const OccupancyGrid& grid, Cell trigger) {
  const std::vector<Cell> region = grow_region(coarse_, trigger, reach_, config_.tau_grow);
  const std::vector<CellSpan> spans = fine_spans(coarse_, region);
  const CellBox box = CellChanges{spans}.box();
  // One cell more than the templates reach, for the places around the best one.
  field_.look_at(grid, box.grown(template_reach_ + 1));
  std::vector<TemplateMatch> on_cells = search(spans);
  std::vector<TemplateMatch> matches = weighed(on_cells, grid);
  if (config_.between_cells) matches = refined(std::move(matches), grid);
  if (fits_without_tolerance(matches, templates_->templates, rule_)) take_tolerance(matches, templates_->templates);
  Matching matching;
  matching.trigger = trigger;
  matching.fits_above = rule_.tau_match;
  matching.region_cells = static_cast<int>(region.size()) * coarse_.n() * coarse_.n();
  matching.region_centre_m = 0.5 * (grid.centre_of(box.min) + grid.centre_of(box.max - Cell{1, 1}));
  matching.degrees = degrees_by_category(matches, *templates_, grid, rule_);
  // Or nearly: what every way to ask knows.
  const bool fitted = std::ranges::any_of(
      matching.degrees, [&](const CategoryDegree& d) { return d.degree > rule_.tau_match - rule_.min_margin; });
  for (const Cell coarse : region) trigger_.matched(coarse, coarse_.ol(coarse), fitted);
  if (config_.degrees == Degrees::above_threshold) {
    std::erase_if(matching.degrees, [](const CategoryDegree& d) { return !d.fits; });
  }
  if (config_.degrees == Degrees::each_template) {
    ScoreRule any = rule_;
    any.tau_match = -1.0;
    matching.templates = templates_above(matches, templates_->templates, any);
  }
  matching.detection = detection_of(matches, std::move(on_cells), grid);
  return matching;
}

std::vector<TemplateMatch> TemplateMatcher::search(std::span<const CellSpan> region) {
  const std::vector<LandmarkTemplate>& templates = templates_->templates;
  if (config_.search == Search::exhaustive) return match_exhaustively(field_, region, templates);
  matcher_.look_at(field_, region);
  std::vector<TemplateMatch> matches;
  std::size_t best = 0;  // of the category; one after the other in a set
  for (std::size_t i = 0; i < templates.size(); ++i) {
    std::int32_t ceiling =
        config_.degrees == Degrees::each_template ? kUnmatched : std::max(ceilings_[i], hidden_ceilings_[i]);
    if (config_.degrees == Degrees::all) {
      const bool is_first = i == 0 || templates[i].category != templates[best].category;
      ceiling = is_first ? kUnmatched : std::max(ceiling, ceiling_beside(matches[best], templates[best], templates[i]));
      if (is_first) best = i;
    }
    matches.push_back(matcher_.best_of(i, ceiling));
    if (fits_better(matches[i], templates[i], matches[best], templates[best])) best = i;
  }
  return matches;
}

// What is hidden counts as fitting to hidden_degree, where it fits worse.
PlaceInCell TemplateMatcher::place_of(std::size_t index, Cell at, bool between, const OccupancyGrid& grid) const {
  const auto measured = [&](const LandmarkTemplate& shape) {
    return between ? place_in_cell(field_, shape, at) : PlaceInCell{{0.0, 0.0}, mismatch_at(field_, shape, at)};
  };
  const LandmarkTemplate& whole = templates_->templates[index];
  const PlaceInCell place = measured(whole);
  if (mismatch_at(field_, whole, at) >= hidden_ceilings_[index]) return place;
  const LandmarkTemplate seen = hidden_.seen_part(grid, index, at);
  const std::size_t hidden_cells = whole.cells.size() - seen.cells.size();
  if (hidden_cells == 0) return place;
  PlaceInCell of_seen = measured(seen);
  of_seen.mismatch += mismatch_ceiling(config_.hidden_degree, hidden_cells, rule_.mu);
  return of_seen.mismatch < place.mismatch ? of_seen : place;
}

std::vector<TemplateMatch> TemplateMatcher::weighed(std::vector<TemplateMatch> matches,
                                                    const OccupancyGrid& grid) const {
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (matches[i].mismatch < hidden_ceilings_[i])
      matches[i].mismatch = place_of(i, matches[i].at, false, grid).mismatch;
  return matches;
}

// Landmarks stand between the cells, and half a cell beside it costs the right category more than a broader
// one: categories are compared where each fits best. What is too bad to matter, by the ceiling of every way to
// ask, stays as it is, so that all ways give the same landmarks.
std::vector<TemplateMatch> TemplateMatcher::refined(std::vector<TemplateMatch> matches,
                                                    const OccupancyGrid& grid) const {
  const std::vector<LandmarkTemplate>& templates = templates_->templates;
  for (std::size_t first = 0, next = 0; first < templates.size(); first = next) {
    std::size_t best = first;
    for (next = first; next < templates.size() && templates[next].category == templates[first].category; ++next)
      if (fits_better(matches[next], templates[next], matches[best], templates[best])) best = next;
    if (matches[best].mismatch >= ceilings_[best]) continue;
    matches[best].mismatch = place_of(best, matches[best].at, true, grid).mismatch;
  }
  return matches;
}

std::optional<Detection> TemplateMatcher::detection_of(const std::vector<TemplateMatch>& matches,
                                                       std::vector<TemplateMatch> on_cells, const OccupancyGrid& grid) {
  const std::vector<LandmarkTemplate>& templates = templates_->templates;
  const std::size_t best = best_template(matches, templates);
  if (!is_decided(best, matches, templates, rule_)) return std::nullopt;
  const LandmarkTemplate& t = templates[best];
  const double degree = degree_of(matches[best].mismatch, t.scored_cells(), rule_.mu);
  std::vector<TemplateDegree> above = templates_above(matches, templates, rule_);
  const Point cell_m = grid.centre_of(matches[best].at);
  if (!config_.between_cells)
    return Detection{t.category, {cell_m.x(), cell_m.y(), wrap_angle(t.orientation_rad)}, degree, std::move(above)};
  const PlaceInCell place = place_of(best, matches[best].at, true, grid);
  const Point at_m = cell_m + grid.cell_m() * place.offset;
  // All three of the parabola where the cells are: the neighbours are not refined.
  complete_neighbours(best, on_cells);
  const double orientation_rad = t.orientation_rad + neighbours_.offset_rad(best, on_cells, templates);
  return Detection{t.category, {at_m.x(), at_m.y(), wrap_angle(orientation_rad)}, degree, std::move(above)};
}

// The orientation between the steps needs the mismatches of both neighbours, however bad they are.
void TemplateMatcher::complete_neighbours(std::size_t index, std::vector<TemplateMatch>& matches) {
  const OrientationNeighbours::Pair pair = neighbours_.of(index);
  for (const std::size_t i : {pair.before, pair.after}) {
    if (matches[i].mismatch == kUnmatched) matches[i] = matcher_.best_of(i, kUnmatched);
  }
}

}  // namespace cairn::template_matcher
