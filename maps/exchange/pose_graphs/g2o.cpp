#include "maps/exchange/pose_graphs/g2o.hpp"

#include <fmt/format.h>

#include <set>
#include <unordered_map>

#include "maps/base/source_text.hpp"
#include "maps/base/spelling.hpp"
#include "maps/exchange/graphs/line_tokens.hpp"

namespace cairn {
namespace {

using exchange::LineTokens;
using exchange::SourceText;

constexpr const char* kVertex = "VERTEX_SE2";
constexpr const char* kEdge = "EDGE_SE2";
constexpr const char* kVertexForm = "VERTEX_SE2 ID X Y THETA";
constexpr const char* kEdgeForm = "EDGE_SE2 FROM TO DX DY DTHETA I11 I12 I13 I22 I23 I33";

struct StatedEdge {
  std::int64_t from = 0;
  std::int64_t to = 0;
  std::size_t from_offset = 0;
  std::size_t to_offset = 0;
  PoseEdge edge;
};

Pose2 pose_in(LineTokens& line, const char* form) {
  const double x_m = line.coordinate_m("x", form);
  const double y_m = line.coordinate_m("y", form);
  return {x_m, y_m, wrap_angle(line.number("theta", form))};
}

StatedEdge edge_in(LineTokens& line) {
  StatedEdge stated;
  stated.from = line.id("the id that the edge comes from", kEdgeForm);
  stated.from_offset = line.offset();
  stated.to = line.id("the id that the edge goes to", kEdgeForm);
  stated.to_offset = line.offset();
  if (stated.from == stated.to) line.fail("an edge joins two vertices");
  stated.edge.T_from_to = pose_in(line, kEdgeForm);
  for (int row = 0; row < 3; ++row)
    for (int column = row; column < 3; ++column) {
      const double value = line.number(fmt::format("I{}{}", row + 1, column + 1), kEdgeForm);
      if (row == column && value < 0.0) line.fail("an information on the diagonal must not be negative");
      stated.edge.information(row, column) = stated.edge.information(column, row) = value;
    }
  return stated;
}

class G2oReader {
 public:
  explicit G2oReader(const SourceText& source) : source_(source), line_(source) {}

  G2oGraph read() {
    while (line_.next_line()) take_line();
    if (read_.ids.empty()) name_vertices_by_edges();
    if (read_.ids.empty()) source_.fail("holds neither a vertex (" + std::string(kVertexForm) + ") nor an edge");
    for (StatedEdge& stated : edges_) {
      stated.edge.from = node_of(stated.from, stated.from_offset);
      stated.edge.to = node_of(stated.to, stated.to_offset);
      read_.graph.edges.push_back(stated.edge);
    }
    return std::move(read_);
  }

 private:
  void take_line() {
    const std::string_view word = line_.token();
    if (word.empty() || word.starts_with('#') || word == "FIX") return;
    if (word == kVertex) {
      take_vertex();
    } else if (word == kEdge) {
      edges_.push_back(edge_in(line_));
    } else {
      line_.fail("unknown word " + in_quotes(word) + did_you_mean(word, {kVertex, kEdge}) +
                 ": a line begins with VERTEX_SE2, EDGE_SE2, FIX or #");
    }
    if (const std::string_view more = line_.rest(); !more.empty())
      line_.fail(in_quotes(more) + " is too much: " + (word == kVertex ? kVertexForm : kEdgeForm));
  }

  void take_vertex() {
    const std::int64_t id = line_.id("the vertex's id", kVertexForm);
    if (!nodes_.emplace(id, read_.ids.size()).second) line_.fail(fmt::format("vertex {} is there already", id));
    read_.ids.push_back(id);
    read_.graph.T_map_node.push_back(pose_in(line_, kVertexForm));
  }

  // Public graphs often hold edges only.
  void name_vertices_by_edges() {
    std::set<std::int64_t> ids;
    for (const StatedEdge& stated : edges_) ids.insert({stated.from, stated.to});
    for (const std::int64_t id : ids) {
      nodes_.emplace(id, read_.ids.size());
      read_.ids.push_back(id);
      read_.graph.T_map_node.emplace_back();
    }
  }

  [[nodiscard]] std::size_t node_of(std::int64_t id, std::size_t offset) const {
    const auto found = nodes_.find(id);
    if (found == nodes_.end()) source_.fail(offset, fmt::format("there is no vertex {}", id));
    return found->second;
  }

  const SourceText& source_;
  LineTokens line_;
  G2oGraph read_;
  std::vector<StatedEdge> edges_;
  std::unordered_map<std::int64_t, std::size_t> nodes_;
};

}  // namespace

G2oGraph parse_g2o(std::string_view text, const std::string& file_name) {
  const SourceText source(text, file_name);
  return G2oReader(source).read();
}

std::string g2o_of(const G2oGraph& graph, std::span<const Pose2> T_map_node) {
  std::string text;
  const auto append = [&](double value) {
    text += ' ';
    exchange::append_number(text, value);
  };
  const auto append_pose = [&](const Pose2& pose) {
    for (const double value : {pose.x_m, pose.y_m, pose.theta_rad}) append(value);
  };
  for (std::size_t i = 0; i < graph.ids.size(); ++i) {
    text += fmt::format("{} {}", kVertex, graph.ids[i]);
    append_pose(T_map_node[i]);
    text += '\n';
  }
  for (const PoseEdge& edge : graph.graph.edges) {
    text += fmt::format("{} {} {}", kEdge, graph.ids[edge.from], graph.ids[edge.to]);
    append_pose(edge.T_from_to);
    for (int row = 0; row < 3; ++row)
      for (int column = row; column < 3; ++column) append(edge.information(row, column));
    text += '\n';
  }
  return text;
}

}  // namespace cairn
