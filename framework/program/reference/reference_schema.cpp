#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "framework/behaviour_tree/nodes.hpp"
#include "framework/program/reference/reference.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

// The loader takes any scalar as text.
const ordered_json kText = {{"type", {"string", "number", "boolean"}}};
const std::string kDefinitions = "#/definitions/";
const std::string kNamed = "named_";    // modules that a list gives names to
const std::string kShared = "shared.";  // groups of settings that several modules have

ordered_json reference_to(const std::string& definition) {
  return {{"$ref", kDefinitions + definition}};
}

ordered_json number_of(double value) {
  return ordered_json::parse(config_detail::number_text(value));
}

ordered_json bounded(const char* type, const Range& range) {
  ordered_json schema = {{"type", type}};
  if (std::isfinite(range.min)) schema["minimum"] = number_of(range.min);
  if (std::isfinite(range.max)) schema["maximum"] = number_of(range.max);
  return schema;
}

ordered_json list_of(const ordered_json& items) {
  return {{"type", "array"}, {"items", items}};
}

ordered_json number_or(const std::vector<std::string>& words) {
  return {{"anyOf", {{{"type", "integer"}, {"minimum", 1}}, {{"enum", words}}}}};
}

ordered_json object_of(const std::vector<FieldSpec>& fields, const std::vector<std::string>& one_of, bool is_module);

ordered_json schema_of_field(const FieldSpec& field);

// Of a schema or a nested field: its map, or the bare value that its shorthand takes.
template <class Described>
ordered_json map_or_shorthand(const Described& described) {
  ordered_json object = object_of(described.fields, described.one_of, false);
  for (const FieldSpec& field : described.fields)
    if (field.key == described.shorthand) return {{"anyOf", {object, schema_of_field(field)}}};
  return object;
}

ordered_json map_of(const FieldSpec& field) {
  if (!field.shared.empty()) return reference_to(kShared + field.shared);
  if (field.fields.empty()) return {{"type", {"object", "null"}}};
  return map_or_shorthand(field);
}

ordered_json shape_of(const FieldSpec& field) {
  ordered_json point = {{"type", "array"}, {"items", bounded("number", field.range)}, {"minItems", 2}, {"maxItems", 2}};
  ordered_json place = {{"anyOf", {kText, point}}};
  if (field.type == "number" || field.type == "integer") return bounded(field.type.c_str(), field.range);
  if (field.type == "flag") return {{"type", "boolean"}};
  if (field.type == "choice") return {{"enum", field.choices}};
  if (field.type == "text" || field.type == "file" || field.type == "input" || field.type == "output") return kText;
  if (field.type == "point") return point;
  if (field.type == "list of points") return list_of(point);
  if (field.type == "place") return place;
  if (field.type == "list of places") return list_of(place);
  if (field.type == "list of numbers") return list_of(bounded("number", field.range));
  if (field.type == "list of integers") return list_of(bounded("integer", field.range));
  if (field.type == "list of choices") return list_of({{"enum", field.choices}});
  if (field.type == "list of texts" || field.type == "list of files") return list_of(kText);
  if (field.type == "map") return map_of(field);
  if (field.type == "list of maps") return list_of(map_of(field));
  if (field.type == "plugin") return reference_to(field.plugin_kind);
  if (field.type == "list of steps") return reference_to("steps");
  if (field.type == "node") return reference_to("child");
  if (field.type == "nodes") return reference_to("nodes");
  if (field.type == "count") return number_or({"all", "any"});
  if (field.type == "rounds") return number_or({"forever"});
  if (field.type == "list of detectors") return list_of(reference_to(kNamed + "detector"));
  return ordered_json::object();  // anything: whoever reads it checks it
}

ordered_json default_of(const FieldSpec& field) {
  if (field.type == "text" || field.type == "file" || field.type == "choice") return field.default_text;
  return ordered_json::parse(field.default_text, nullptr, false);
}

ordered_json schema_of_field(const FieldSpec& field) {
  ordered_json schema = {{"description", field.meaning + (field.unit.empty() ? "" : " [" + field.unit + "]")}};
  schema.update(shape_of(field));
  if (!field.required && !field.default_text.empty() && field.type != "plugin") {
    if (ordered_json value = default_of(field); !value.is_discarded()) schema["default"] = std::move(value);
  }
  return schema;
}

ordered_json object_of(const std::vector<FieldSpec>& fields, const std::vector<std::string>& one_of, bool is_module) {
  ordered_json properties = ordered_json::object();
  if (is_module) properties["plugin"] = true;
  ordered_json required = ordered_json::array();
  for (const FieldSpec& field : fields) {
    properties[field.key] = schema_of_field(field);
    if (field.required) required.push_back(field.key);
  }
  ordered_json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (required.empty() && one_of.empty()) schema["type"] = {"object", "null"};  // `start:` with nothing after it
  if (!required.empty()) schema["required"] = required;
  for (const std::string& key : one_of) schema["oneOf"].push_back({{"required", {key}}});
  return schema;
}

std::string definition_of(const RegisteredModule& module) {
  return std::string(name_of(module.kind)) + "." + module.name;
}

// Which modules of a kind there are, and the settings of the one that is named.
ordered_json choice_of(PluginKind kind, const ModuleLibrary& library, const std::string& prefix = "") {
  ordered_json names = ordered_json::array();
  ordered_json cases = ordered_json::array();
  std::string about = "which module does it:";
  for (const ModuleEntry& entry : library.entries()) {
    const RegisteredModule& module = *entry.module;
    if (!serves_as(module.kind, kind)) continue;
    names.push_back(module.name);
    about += "\n- " + module.name + ": " + module.summary;
    cases.push_back({{"if", {{"required", {"plugin"}}, {"properties", {{"plugin", {{"const", module.name}}}}}}},
                     {"then", reference_to(prefix + definition_of(module))}});
  }
  ordered_json schema = {{"type", "object"}, {"required", {"plugin"}}};
  schema["properties"]["plugin"] = {{"description", about}, {"enum", names}};
  if (!cases.empty()) schema["allOf"] = cases;
  return schema;
}

bool has_required(const Schema& schema) {
  for (const FieldSpec& field : schema.fields)
    if (field.required) return true;
  return false;
}

ordered_json behind_node(const NodeType& type) {
  if (type.shape == NodeShape::nodes) return reference_to("nodes");
  return type.shape == NodeShape::one_node ? reference_to("child") : map_or_shorthand(type.schema);
}

// `- name: settings`, or the bare name of a behaviour that needs none; `name` beside it is for people.
ordered_json node_of(const ModuleLibrary& library) {
  ordered_json bare = ordered_json::array();
  ordered_json properties = ordered_json::object();
  for (const ModuleEntry& entry : library.entries()) {
    const RegisteredModule& module = *entry.module;
    if (module.kind != PluginKind::behaviour) continue;
    if (!has_required(module.schema)) bare.push_back(module.name);
    properties[module.name] = {{"description", module.summary}};
    properties[module.name].update(reference_to(definition_of(module)));
  }
  for (const NodeType& type : node_types()) {
    const std::string name(name_of(type.kind));
    properties[name] = {{"description", type.about}};
    properties[name].update(behind_node(type));
  }
  std::optional<ordered_json> behaviour_called_name;
  if (properties.contains("name")) behaviour_called_name = properties["name"];
  properties["name"] = {{"description", "what to call the node"}, {"type", "string"}, {"minLength", 1}};
  const auto keys = [](int number) { return ordered_json{{"minProperties", number}, {"maxProperties", number}}; };
  const ordered_json map = {
      {"type", "object"}, {"properties", properties}, {"additionalProperties", false}, {"if", {{"required", {"name"}}}},
      {"then", keys(2)},  {"else", keys(1)}};
  ordered_json node = {{"anyOf", {map, {{"enum", bare}}}}};
  // Alone and with settings, `name` is a behaviour.
  if (behaviour_called_name)
    node["anyOf"].push_back({{"type", "object"},
                             {"properties", {{"name", {{"allOf", {*behaviour_called_name, {{"type", "object"}}}}}}}},
                             {"required", {"name"}},
                             {"additionalProperties", false}});
  return node;
}

void add_nodes(ordered_json& definitions, const ModuleLibrary& library) {
  definitions["steps"] = list_of(reference_to("node"));
  definitions["node"] = node_of(library);
  definitions["nodes"] = list_of(reference_to("node"));
  definitions["nodes"]["minItems"] = 1;
  definitions["child"] = {{"anyOf", {reference_to("node"), reference_to("nodes")}}};
}

void add_shared(ordered_json& definitions, const ModuleLibrary& library) {
  for (const ModuleEntry& entry : library.entries())
    for (const FieldSpec& field : entry.module->schema.fields)
      if (!field.shared.empty()) definitions[kShared + field.shared] = map_or_shorthand(field);
}

void add_behaviours(ordered_json& definitions, const ModuleLibrary& library) {
  add_shared(definitions, library);
  for (const ModuleEntry& entry : library.entries()) {
    const RegisteredModule& module = *entry.module;
    if (module.kind == PluginKind::behaviour) definitions[definition_of(module)] = map_or_shorthand(module.schema);
  }
}

// In a sub-mission a parameter may stand for any value.
void allow_parameters(ordered_json& schema) {
  if (!schema.is_structured()) return;
  for (ordered_json& inner : schema) allow_parameters(inner);
  const auto allow = [](ordered_json& value) { value = {{"anyOf", {value, reference_to("parameter")}}}; };
  if (!schema.is_object()) return;
  if (schema.contains("properties"))
    for (ordered_json& property : schema["properties"])
      if (property.is_object()) allow(property);
  if (schema.contains("items")) allow(schema["items"]);
}

ordered_json parameter() {
  return {{"description", "a parameter of the sub-mission"},
          {"type", "string"},
          {"pattern", "^\\$[A-Za-z_][A-Za-z0-9_]*$"}};
}

ordered_json definitions_of(const ModuleLibrary& library) {
  ordered_json definitions = ordered_json::object();
  for (const PluginKind kind : kPluginKinds)
    if (kind != PluginKind::behaviour) definitions[std::string(name_of(kind))] = choice_of(kind, library);
  add_nodes(definitions, library);
  for (const ModuleEntry& entry : library.entries()) {
    const RegisteredModule& module = *entry.module;
    if (module.kind != PluginKind::behaviour)
      definitions[definition_of(module)] = object_of(module.schema.fields, module.schema.one_of, true);
  }
  add_behaviours(definitions, library);
  return definitions;
}

// Detectors that also have a `name`.
ordered_json named_definitions_of(const ModuleLibrary& library) {
  ordered_json definitions = ordered_json::object();
  ordered_json& choice = definitions[kNamed + "detector"];
  choice = choice_of(PluginKind::detector, library, kNamed);
  choice["required"].push_back("name");
  choice["properties"]["name"] = kText;
  for (const ModuleEntry& entry : library.entries()) {
    if (entry.module->kind != PluginKind::detector) continue;
    ordered_json object = object_of(entry.module->schema.fields, entry.module->schema.one_of, true);
    object["properties"]["name"] = true;
    definitions[kNamed + definition_of(*entry.module)] = std::move(object);
  }
  return definitions;
}

bool has_field_of(const Schema& schema, const std::string& type) {
  return std::ranges::find(schema.fields, type, &FieldSpec::type) != schema.fields.end();
}

}  // namespace

std::vector<SchemaFile> reference_schemas(const ModuleLibrary& library) {
  std::vector<SchemaFile> files;
  for (const DescribedFile& file : described_files()) {
    ordered_json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                           {"title", "Cairn " + file.name},
                           {"description", file.about}};
    schema.update(object_of(file.schema.fields, file.schema.one_of, false));
    if (has_field_of(file.schema, "plugin") || has_field_of(file.schema, "list of steps"))
      schema["definitions"] = definitions_of(library);
    if (file.name == "sub_mission") {
      schema["definitions"] = ordered_json::object();
      add_nodes(schema["definitions"], library);
      add_behaviours(schema["definitions"], library);
      allow_parameters(schema["definitions"]);
      schema["definitions"]["parameter"] = parameter();
    }
    if (has_field_of(file.schema, "list of detectors")) schema["definitions"] = named_definitions_of(library);
    files.push_back({file.name + ".schema.json", schema.dump(2) + "\n"});
  }
  return files;
}

}  // namespace cairn
