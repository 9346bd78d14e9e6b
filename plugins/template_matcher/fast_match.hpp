// The matcher that missions use: the answer of the exhaustive one to the bit, at a small part of its cost
// (docs/decisions/0007-fast-matching.md).
#pragma once

#include <map>
#include <span>
#include <vector>

#include "plugins/template_matcher/match.hpp"
#include "plugins/template_matcher/match_kernels.hpp"

namespace cairn::template_matcher {

// How it saves work, without ever losing a place: the distance of two gradients is at least the
// difference of their projections on any direction. So a template's mismatch is at least the sum, over
// its cells, of what the field's projection falls short of the cell's, along the one of a few fixed
// directions that is nearest to the cell's gradient. These sums are made of small whole numbers read in
// order, first for blocks of 2 x 2 places at once (by the largest projection in the block), then for the
// places of the blocks that are left; what is then left is computed exactly, the most promising first.
// Keeps its memory from one call to the next; not thread-safe.
class FastMatcher {
 public:
  // Throws std::invalid_argument for a template of more than kMaxCells cells.
  explicit FastMatcher(std::span<const LandmarkTemplate> templates);
  static constexpr std::size_t kMaxCells = 20000;

  // Where to search from now on. The field must outlive the searches. Field and region as for
  // match_exhaustively().
  void look_at(const GradientField& field, std::span<const CellSpan> region);
  // What match_exhaustively() gives for a template, if the mismatch there is below the ceiling, and
  // kUnmatched if not. kUnmatched as the ceiling asks for the best place however bad it is.
  [[nodiscard]] TemplateMatch best_of(std::size_t index, std::int32_t ceiling);

  // Both for every template; one ceiling a template.
  [[nodiscard]] std::vector<TemplateMatch> match(const GradientField& field, std::span<const CellSpan> region,
                                                 std::span<const std::int32_t> ceilings);

 private:
  // Where a template cell's projection is found: in which map, and how far from a place's own entry.
  struct MapPlace {
    std::size_t map = 0;
    std::size_t x = 0;
    std::size_t y = 0;
  };
  struct PreparedTemplate {
    std::vector<MapPlace> block_map_places;
    std::vector<MapPlace> place_map_places;
    std::vector<std::uint16_t> block_wanted;
    std::vector<std::uint16_t> place_wanted;
    std::vector<GradientCell> cells;
    GradientColumns columns;  // the same
  };
  // How the maps of regions of one width lie in memory, and where each template's cells are found in them.
  struct Layout {
    ProjectionMaps place_maps;
    BlockMaps block_maps;
    std::vector<std::vector<BoundCell>> place_cells;
    std::vector<std::vector<BoundCell>> block_cells;
  };
  struct Search;  // of one template

  [[nodiscard]] PreparedTemplate prepared(const LandmarkTemplate& shape) const;
  [[nodiscard]] Layout layout_for(std::size_t width, std::size_t height) const;
  void choose_layout(std::size_t width, std::size_t height);
  void prepare_maps(const GradientField& field);
  void prepare_places(std::span<const CellSpan> region);
  [[nodiscard]] std::uint16_t place_limit(const Search& search) const;
  [[nodiscard]] std::uint16_t block_limit(const Search& search) const;
  [[nodiscard]] static std::uint16_t limit_in(std::int64_t unit, const Search& search);
  void search_template(Search& search);
  void find_first_limit(Search& search);
  [[nodiscard]] std::size_t first_place_of(std::size_t block) const;
  void bound_piece(const Search& search, std::size_t place);
  void compute_from(Search& search, std::size_t place);
  void compute_piece(Search& search, std::size_t place);
  [[nodiscard]] Cell cell_of(std::size_t place) const;
  static void settle(Search& search, const TemplateMatch& match);

  int reach_ = 0;
  int shift_ = 0;
  std::uint16_t offset_ = 0;
  std::vector<PreparedTemplate> templates_;
  std::map<std::size_t, Layout> layouts_;  // by width

  // Of the current region. Places are cells of `places_`, numbered row by row, place_maps_.stride a row;
  // blocks are 2 x 2 places, block_maps_.stride a row.
  const GradientField* field_ = nullptr;
  CellBox places_;
  std::size_t block_count_ = 0;
  std::vector<std::uint16_t> place_values_;  // of the maps
  std::vector<std::uint8_t> block_values_;
  const Layout* layout_ = nullptr;
  ProjectionMaps place_maps_;
  BlockMaps block_maps_;
  std::vector<std::uint16_t> place_start_, block_start_;  // 0 in the region, kOutside elsewhere
  std::vector<std::uint16_t> place_sums_, block_sums_;    // kOutside where not known or done with
  std::vector<std::uint32_t> candidates_;
};

}  // namespace cairn::template_matcher
