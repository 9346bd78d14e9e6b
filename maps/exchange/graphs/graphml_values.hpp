// The values that a GraphML node, edge or graph has for its keys, taken out one by one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "maps/base/source_text.hpp"
#include "maps/landmarks/marker_id.hpp"

namespace cairn::exchange {

// A reference like "&#xD800;" makes a text that is not UTF-8: throws ExchangeError.
void check_text(const SourceText& source, std::string_view text, std::size_t offset);
inline constexpr std::string_view kXmlBlanks = " \t\r\n";

struct GraphmlValue {
  std::string_view name;  // attr.name of its key
  std::string_view type;  // attr.type
  std::string_view text;
  std::size_t offset = 0;  // of its element
};

// Refers to the text of the file and of the values. What cannot be read throws ExchangeError with its place.
class GraphmlValues {
 public:
  using Names = std::vector<std::string_view>;

  GraphmlValues(const SourceText& source, std::vector<GraphmlValue> values);

  // The value of the first of these names that is there; it is there no longer.
  std::optional<GraphmlValue> take(const Names& names);
  std::optional<double> take_number(const Names& names);  // finite
  std::optional<double> take_coordinate(const Names& names);
  bool take_flag(std::string_view name);
  int take_level();
  std::string take_text(const Names& names);
  // Everything that is left, as the text of a JSON object; empty when nothing is.
  std::optional<MarkerId> take_marker();  // of the key april_tag
  std::string take_annotations();

 private:
  [[nodiscard]] double number(const GraphmlValue& value) const;
  [[nodiscard]] bool flag(const GraphmlValue& value) const;

  const SourceText& source_;
  std::vector<GraphmlValue> values_;
};

}  // namespace cairn::exchange
