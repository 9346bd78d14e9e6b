#include <iostream>
#include <stdexcept>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/output_files.hpp"
#include "framework/program/reference/reference.hpp"

namespace cairn {
namespace {

void write_reference(const std::filesystem::path& file, const std::string& text) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_file(file, text);
  std::cerr << "wrote " << file.string() << "\n";
}

}  // namespace

int plugins_reference(const ReferenceCommand& command, const CommonOptions& common) {
  const ModuleLibrary library = module_library(common);
  static_cast<void>(library.entries());  // opens all, so that what fails is a fault
  if (!library.faults().empty()) {
    std::string sentence = "a reference without these modules would be incomplete:";
    for (const std::string& fault : library.faults()) sentence += "\n  not loaded: " + fault;
    throw std::runtime_error(sentence);
  }
  if (!command.schema_folder.empty())
    for (const SchemaFile& schema : reference_schemas(library))
      write_reference(command.schema_folder / schema.file_name, schema.text);
  if (!command.markdown.empty()) write_reference(command.markdown, reference_markdown(library));
  if (command.markdown.empty() && command.schema_folder.empty()) std::cout << reference_markdown(library);
  return kExitDone;
}

}  // namespace cairn
