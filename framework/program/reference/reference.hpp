// The configuration reference (Markdown) and the JSON schemas (draft-07), both made from the field
// descriptions that load the files: what they say is what the loader does.
#pragma once

#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/modules/module_library.hpp"

namespace cairn {

// A kind of file that people write.
struct DescribedFile {
  std::string name;    // "mission"
  std::string folder;  // where the shipped ones are: "config/missions"
  std::string about;
  Schema schema;
};
[[nodiscard]] std::vector<DescribedFile> described_files();

struct SchemaFile {
  std::string file_name;  // "mission.schema.json"
  std::string text;
};

// Modules are those of the library, by kind and name; the same library gives the same bytes.
[[nodiscard]] std::string reference_markdown(const ModuleLibrary& library);
[[nodiscard]] std::vector<SchemaFile> reference_schemas(const ModuleLibrary& library);

}  // namespace cairn
