#include "plugins/template_matcher/fast_match.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace cairn::template_matcher {
namespace {

constexpr std::uint16_t kOutside = std::numeric_limits<std::uint16_t>::max();
constexpr std::size_t kMaxLayouts = 16;   // a whole set of templates each
constexpr int kLargestProjection = 1443;  // of a gradient with both parts within +-1020

std::size_t rounded_up(std::size_t count, std::size_t step) {
  return (count + step - 1) / step * step;
}

int projection(const TemplateCell& cell, int k) {
  const Direction u = direction(k);
  return u.x * cell.gradient_x + u.y * cell.gradient_y;  // in 1/16384
}

int nearest_direction(const TemplateCell& cell) {
  int best = 0;
  for (int k = 1; k < kDirections; ++k) {
    if (projection(cell, k) > projection(cell, best)) best = k;
  }
  return best;
}

std::uint16_t offset_of(int shift) {
  return static_cast<std::uint16_t>((kLargestProjection >> shift) + 1);
}

std::uint16_t wanted(const TemplateCell& cell, int shift) {
  return static_cast<std::uint16_t>((projection(cell, nearest_direction(cell)) >> (14 + shift)) + offset_of(shift));
}

// The finest unit in which no template's sum of shortfalls can reach kOutside, and the maps of blocks fit bytes.
int finest_shift(std::span<const LandmarkTemplate> templates) {
  for (const LandmarkTemplate& t : templates) {
    if (t.cells.size() <= FastMatcher::kMaxCells) continue;
    throw std::invalid_argument("a template of category \"" + t.category + "\" has " + std::to_string(t.cells.size()) +
                                " cells, more than " + std::to_string(FastMatcher::kMaxCells) +
                                "; larger cells would do");
  }
  for (int shift = 3;; ++shift) {
    const bool fits = std::all_of(templates.begin(), templates.end(), [&](const LandmarkTemplate& t) {
      std::int64_t most = 0;
      for (const TemplateCell& cell : t.cells) most += wanted(cell, shift);
      return most < kOutside;
    });
    if (fits) return shift;
  }
}

// Where the mismatch is equal the lower row, then the column further left, wins.
bool is_better(const TemplateMatch& a, const TemplateMatch& b) {
  if (a.mismatch != b.mismatch) return a.mismatch < b.mismatch;
  return a.at.y != b.at.y ? a.at.y < b.at.y : a.at.x < b.at.x;
}

}  // namespace

struct FastMatcher::Search {
  const GradientField& field;
  const PreparedTemplate& shape;
  std::size_t index;  // of the template
  std::int64_t most;  // only places with at most this mismatch can still be the answer
  TemplateMatch best = {};
};

FastMatcher::FastMatcher(std::span<const LandmarkTemplate> templates)
    : reach_(reach_of(templates)), shift_(finest_shift(templates)), offset_(offset_of(shift_)) {
  for (const LandmarkTemplate& t : templates) templates_.push_back(prepared(t));
}

FastMatcher::PreparedTemplate FastMatcher::prepared(const LandmarkTemplate& shape) const {
  // Steep cells first: over flat floor they add up soonest.
  std::vector<TemplateCell> cells = shape.cells;
  std::stable_sort(cells.begin(), cells.end(),
                   [&](const TemplateCell& a, const TemplateCell& b) { return wanted(a, shift_) > wanted(b, shift_); });
  PreparedTemplate prepared;
  for (const TemplateCell& cell : cells) {
    const auto k = static_cast<std::size_t>(nearest_direction(cell));
    const int x = cell.offset.x + reach_;
    const int y = cell.offset.y + reach_;
    const std::uint16_t w = wanted(cell, shift_);
    const auto coarse = static_cast<std::uint16_t>(std::min(w >> kCoarserBits, 255));
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    prepared.place_map_places.push_back({k, column, row});
    prepared.place_wanted.push_back(w);
    prepared.block_map_places.push_back({4 * k + 2 * (row % 2) + column % 2, column / 2, row / 2});
    prepared.block_wanted.push_back(coarse);
    prepared.cells.push_back({cell.offset.x, cell.offset.y, cell.gradient_x, cell.gradient_y});
    prepared.columns.push_back(prepared.cells.back());
  }
  return prepared;
}

FastMatcher::Layout FastMatcher::layout_for(std::size_t width, std::size_t height) const {
  const std::size_t block_stride = (width + 1) / 2;
  Layout layout;
  layout.place_maps = {nullptr, (height + 2) * width + 4 * kPlacesPerPiece, width};
  layout.block_maps = {nullptr, (height / 2 + 2) * block_stride + 2 * kPlacesPerGroup, block_stride};
  const auto located = [](const std::vector<MapPlace>& places, const std::vector<std::uint16_t>& wanted,
                          const auto& maps) {
    std::vector<BoundCell> cells;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const MapPlace& p = places[i];
      cells.push_back({static_cast<std::uint32_t>(p.map * maps.map_size + p.y * maps.stride + p.x), wanted[i]});
    }
    return cells;
  };
  for (const PreparedTemplate& t : templates_) {
    layout.place_cells.push_back(located(t.place_map_places, t.place_wanted, layout.place_maps));
    layout.block_cells.push_back(located(t.block_map_places, t.block_wanted, layout.block_maps));
  }
  return layout;
}

// Regions have few different widths: soon every layout is there.
void FastMatcher::choose_layout(std::size_t width, std::size_t height) {
  const auto known = layouts_.find(width);
  const std::size_t min_size = (height + 2) * width + 4 * kPlacesPerPiece;
  if (known == layouts_.end() || known->second.place_maps.map_size < min_size) {
    if (layouts_.size() >= kMaxLayouts) layouts_.clear();
    layouts_.insert_or_assign(width, layout_for(width, std::max(height, width)));
  }
  layout_ = &layouts_.at(width);
  place_maps_ = layout_->place_maps;
  block_maps_ = layout_->block_maps;
  place_values_.resize(std::max(place_values_.size(), place_maps_.map_size * kDirections));
  block_values_.resize(std::max(block_values_.size(), 4 * block_maps_.map_size * kDirections));
  place_maps_.first = place_values_.data();
  block_maps_.first = block_values_.data();
}

void FastMatcher::prepare_maps(const GradientField& field) {
  const auto width = static_cast<std::size_t>(places_.width()) + 2 * static_cast<std::size_t>(reach_);
  const auto height = static_cast<std::size_t>(places_.height()) + 2 * static_cast<std::size_t>(reach_);
  choose_layout(width, height);
  const Cell first = places_.min - Cell{reach_, reach_};
  project({field.x_from(first), field.y_from(first), field.stride(), width, height, shift_, offset_},
          place_values_.data(), place_maps_.map_size, width);
  pool(place_maps_, width, height, block_values_.data(), block_maps_.map_size, block_maps_.stride);
}

void FastMatcher::prepare_places(std::span<const CellSpan> region) {
  const auto rows = static_cast<std::size_t>(places_.height()) + 1;
  block_count_ = rounded_up(rows / 2 * block_maps_.stride, kPlacesPerGroup);
  place_start_.assign(rounded_up(rows * place_maps_.stride, kPlacesPerPiece) + kPlacesPerPiece, kOutside);
  place_sums_.resize(place_start_.size());
  block_start_.assign(block_count_, kOutside);
  block_sums_.resize(block_count_);
  candidates_.resize(std::max(block_count_, place_sums_.size()));
  for (const CellSpan& span : region) {
    const auto row = static_cast<std::size_t>(span.y - places_.min.y);
    const auto begin = static_cast<std::size_t>(span.x_begin - places_.min.x);
    const auto end = static_cast<std::size_t>(span.x_end - places_.min.x);
    std::fill_n(place_start_.begin() + static_cast<std::ptrdiff_t>(row * place_maps_.stride + begin), end - begin, 0);
    std::fill_n(block_start_.begin() + static_cast<std::ptrdiff_t>(row / 2 * block_maps_.stride + begin / 2),
                (end + 1) / 2 - begin / 2, 0);
  }
}

// Places and blocks with sums from here on are no longer of interest. Each shortfall is rounded down, but
// each distance of the exact mismatch to the nearest: a place may seem worse by half a unit a cell.
std::uint16_t FastMatcher::place_limit(const Search& search) const {
  return limit_in(std::int64_t{kMismatchPerUnit} << shift_, search);
}

std::uint16_t FastMatcher::block_limit(const Search& search) const {
  return limit_in(std::int64_t{kMismatchPerUnit} << (shift_ + kCoarserBits), search);
}

std::uint16_t FastMatcher::limit_in(std::int64_t unit, const Search& search) {
  const auto cells = static_cast<std::int64_t>(search.shape.cells.size());
  return static_cast<std::uint16_t>(std::min<std::int64_t>((search.most + cells) / unit + 1, kOutside));
}

void FastMatcher::look_at(const GradientField& field, std::span<const CellSpan> region) {
  field_ = &field;
  places_ = {};
  for (const CellSpan& s : region) places_ = united(places_, {{s.x_begin, s.y}, {s.x_end, s.y + 1}});
  prepare_maps(field);
  prepare_places(region);
}

TemplateMatch FastMatcher::best_of(std::size_t index, std::int32_t ceiling) {
  Search search{*field_, templates_[index], index, std::int64_t{ceiling} - 1};
  if (search.most >= 0) search_template(search);
  return search.best;
}

std::vector<TemplateMatch> FastMatcher::match(const GradientField& field, std::span<const CellSpan> region,
                                              std::span<const std::int32_t> ceilings) {
  look_at(field, region);
  std::vector<TemplateMatch> matches;
  for (std::size_t i = 0; i < templates_.size(); ++i) matches.push_back(best_of(i, ceilings[i]));
  return matches;
}

void FastMatcher::search_template(Search& search) {
  sum_block_shortfalls(block_maps_.first, layout_->block_cells[search.index], block_limit(search), block_start_.data(),
                       block_count_, block_sums_.data());
  if (block_limit(search) == kOutside) find_first_limit(search);
  const std::size_t blocks = collect_below(block_sums_.data(), block_count_, block_limit(search), candidates_.data());
  if (blocks == 0) return;
  std::fill(place_sums_.begin(), place_sums_.end(), kOutside);
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::size_t place = first_place_of(candidates_[i]);
    bound_piece(search, place);
    bound_piece(search, place + 1);
    bound_piece(search, place + place_maps_.stride);
    bound_piece(search, place + place_maps_.stride + 1);
  }
  const std::size_t places =
      collect_below(place_sums_.data(), place_sums_.size(), place_limit(search), candidates_.data());
  const auto end = candidates_.begin() + static_cast<std::ptrdiff_t>(places);
  std::sort(candidates_.begin(), end, [&](std::uint32_t a, std::uint32_t b) {
    return place_sums_[a] != place_sums_[b] ? place_sums_[a] < place_sums_[b] : a < b;
  });
  for (auto place = candidates_.begin(); place != end; ++place) {
    if (place_sums_[*place] < place_limit(search)) compute_from(search, *place);
  }
}

// Without a limit every place would be looked at: the most promising block gives one.
void FastMatcher::find_first_limit(Search& search) {
  const auto least = std::min_element(block_sums_.begin(), block_sums_.end());
  const std::size_t place = first_place_of(static_cast<std::size_t>(least - block_sums_.begin()));
  place_sums_ = place_start_;
  compute_piece(search, place);
  if (place_start_[place + place_maps_.stride] != kOutside) compute_piece(search, place + place_maps_.stride);
}

std::size_t FastMatcher::first_place_of(std::size_t block) const {
  return 2 * (block / block_maps_.stride) * place_maps_.stride + 2 * (block % block_maps_.stride);
}

// Sums the shortfalls of the piece that holds the place, unless that is done.
void FastMatcher::bound_piece(const Search& search, std::size_t place) {
  const std::size_t first = place / kPlacesPerPiece * kPlacesPerPiece;
  if (place_start_[place] == kOutside || place_sums_[place] != kOutside) return;
  sum_segment_shortfalls(place_maps_.first, layout_->place_cells[search.index], place_limit(search),
                         place_start_.data(), first, place_sums_.data() + first);
}

// Computes a place, and its neighbours with it where most of them are wanted too.
void FastMatcher::compute_from(Search& search, std::size_t place) {
  constexpr std::ptrdiff_t kWorthAll = 6;
  const auto first = place_sums_.begin() + static_cast<std::ptrdiff_t>(place);
  const std::uint16_t limit = place_limit(search);
  if (std::count_if(first, first + kPlacesPerExactPiece, [&](auto sum) { return sum < limit; }) >= kWorthAll) {
    compute_piece(search, place);
    return;
  }
  const Cell at = cell_of(place);
  *first = kOutside;
  const std::int32_t mismatch =
      sum_distance(search.field.both_from(at), static_cast<std::ptrdiff_t>(search.field.stride()), search.shape.columns,
                   static_cast<std::int32_t>(search.most));
  settle(search, {at, mismatch});
}

Cell FastMatcher::cell_of(std::size_t place) const {
  return places_.min + Cell{static_cast<int>(place % place_maps_.stride), static_cast<int>(place / place_maps_.stride)};
}

void FastMatcher::settle(Search& search, const TemplateMatch& match) {
  if (match.mismatch > search.most || !is_better(match, search.best)) return;
  search.best = match;
  search.most = match.mismatch;
}

// Computes some places of one row, from this one on.
void FastMatcher::compute_piece(Search& search, std::size_t place) {
  const Cell at = cell_of(place);
  const int count = std::min(static_cast<int>(kPlacesPerExactPiece), places_.max.x - at.x);
  const auto first = place_sums_.begin() + static_cast<std::ptrdiff_t>(place);
  std::fill(first, first + count, kOutside);
  const std::int16_t* x = search.field.x_from(at);
  const std::int16_t* y = search.field.y_from(at);
  const auto stride = static_cast<std::ptrdiff_t>(search.field.stride());
  std::int32_t mismatches[kPlacesPerExactPiece];
  sum_distances(x, y, stride, search.shape.cells, static_cast<std::int32_t>(search.most), mismatches);
  for (int i = 0; i < count; ++i) {
    const std::size_t here = place + static_cast<std::size_t>(i);
    if (place_start_[here] != kOutside) settle(search, {at + Cell{i, 0}, mismatches[i]});
  }
}

}  // namespace cairn::template_matcher
