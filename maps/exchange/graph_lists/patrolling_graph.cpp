#include "maps/exchange/graph_lists/patrolling_graph.hpp"

#include <fmt/format.h>

#include "maps/base/source_text.hpp"
#include "maps/exchange/graphs/file_ids.hpp"
#include "maps/exchange/graphs/line_tokens.hpp"

namespace cairn {
namespace {

using exchange::FileId;
using exchange::LineTokens;
using exchange::NodeIds;
using exchange::SourceText;

constexpr const char* kHeadForm = "N WIDTH_PX HEIGHT_PX RESOLUTION_M OFFSET_X_M OFFSET_Y_M";
constexpr const char* kVertexForm = "ID X_PX Y_PX DEGREE";
constexpr const char* kNeighbourForm = "NEIGHBOUR DIRECTION COST_PX";

struct Head {
  std::int64_t vertices = 0;
  double resolution_m = 0.0;
  Point offset_m = Point::Zero();
};

struct Neighbour {
  std::int64_t from = 0;
  std::int64_t to = 0;
  double cost_m = 0.0;
  std::size_t offset = 0;  // of `to`
};

struct Vertices {
  std::vector<FileId> ids;
  std::vector<Point> at_m;
  std::vector<Neighbour> neighbours;
};

class PatrollingReader {
 public:
  explicit PatrollingReader(const SourceText& source) : tokens_(source) {}

  Head head() {
    Head head;
    head.vertices = count("the number of vertices", kHeadForm);
    if (head.vertices < 1) tokens_.fail("a graph has at least one vertex");
    (void)number("the width", kHeadForm);
    (void)number("the height", kHeadForm);
    head.resolution_m = number("the resolution", kHeadForm);
    if (head.resolution_m <= 0.0) tokens_.fail("the resolution must be above 0 m a pixel");
    head.offset_m = {number("the offset in x", kHeadForm), number("the offset in y", kHeadForm)};
    return head;
  }

  Vertices vertices(const Head& head) {
    Vertices vertices;
    for (std::int64_t i = 0; i < head.vertices; ++i) take_vertex(head, vertices);
    if (tokens_.to_next_token()) {
      (void)tokens_.token();
      tokens_.fail(fmt::format("there is more after the {} vertices that the first line states", head.vertices));
    }
    return vertices;
  }

 private:
  void take_vertex(const Head& head, Vertices& vertices) {
    const std::int64_t id = count("the vertex's id", kVertexForm);
    vertices.ids.push_back({id, tokens_.offset()});
    const double x_m = coordinate_m("x_px", head.offset_m.x(), head);
    const double y_m = coordinate_m("y_px", head.offset_m.y(), head);
    vertices.at_m.push_back({x_m, y_m});
    const std::int64_t degree = count("the number of neighbours", kVertexForm);
    for (std::int64_t k = 0; k < degree; ++k) {
      Neighbour neighbour;
      neighbour.from = id;
      neighbour.to = count("the neighbour's id", kNeighbourForm);
      neighbour.offset = tokens_.offset();
      tokens_.to_next_token();
      if (tokens_.token().empty()) tokens_.fail(std::string("the direction is missing: ") + kNeighbourForm);
      neighbour.cost_m = number("the cost", kNeighbourForm) * head.resolution_m;
      if (neighbour.cost_m < 0.0) tokens_.fail("the cost must not be negative");
      vertices.neighbours.push_back(neighbour);
    }
  }

  std::int64_t count(const char* what, const char* form) {
    tokens_.to_next_token();
    return tokens_.id(what, form);
  }
  double number(const char* what, const char* form) {
    tokens_.to_next_token();
    return tokens_.number(what, form);
  }
  double coordinate_m(const char* what, double offset_m, const Head& head) {
    const double at_m = number(what, kVertexForm) * head.resolution_m + offset_m;
    if (!(std::abs(at_m) <= exchange::kMaxCoordinate_m))
      tokens_.fail(fmt::format("{} is {:g} m in the map, allowed are {:g} m", what, at_m, exchange::kMaxCoordinate_m));
    return at_m;
  }

  LineTokens tokens_;
};

}  // namespace

bool is_patrolling_graph(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] >= '0' && text[first] <= '9';
}

ImportedGraph parse_patrolling_graph(std::string_view text, const std::string& file_name) {
  const SourceText source(text, file_name);
  PatrollingReader reader(source);
  const Head head = reader.head();
  const Vertices vertices = reader.vertices(head);
  const NodeIds ids(vertices.ids, source);
  ImportedGraph imported;
  for (std::size_t i = 0; i < vertices.ids.size(); ++i) {
    Landmark landmark;
    landmark.id = ids.landmark_of(vertices.ids[i].id);
    if (vertices.ids[i].id == 0) landmark.name = "0";
    landmark.T_map_landmark = {vertices.at_m[i].x(), vertices.at_m[i].y(), 0.0};
    imported.graph.add(std::move(landmark));
  }
  for (const Neighbour& neighbour : vertices.neighbours) {
    Route route;
    route.from = ids.landmark_of(neighbour.from);
    route.to = ids.landmark_of(neighbour.to);
    if (route.to == 0) source.fail(neighbour.offset, fmt::format("there is no vertex {}", neighbour.to));
    route.cost_m = neighbour.cost_m;
    imported.graph.add_route(std::move(route));
  }
  ids.warn_of_zero(imported.warnings);
  return imported;
}

}  // namespace cairn
