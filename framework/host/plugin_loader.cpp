#include "framework/host/plugin_loader.hpp"

#include <boost/dll/shared_library.hpp>
#include <cstring>
#include <exception>

namespace cairn {
namespace {

using boost::dll::shared_library;

std::shared_ptr<shared_library> open(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) throw PluginError(file.string() + ": no such file");
  auto library = std::make_shared<shared_library>();
  try {
    library->load(boost::dll::fs::path(std::filesystem::absolute(file).string()),
                  boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
  } catch (const std::exception& error) {
    throw PluginError(file.string() + ": cannot be opened as a module: " + error.what());
  }
  return library;
}

void check_stamp(const std::filesystem::path& file, const shared_library& library) {
  if (!library.has("cairn_abi_stamp") || !library.has("cairn_register_module"))
    throw PluginError(file.string() + ": is no Cairn module (it exports no " +
                      (library.has("cairn_abi_stamp") ? "cairn_register_module" : "cairn_abi_stamp") +
                      "; end its module.cpp with CAIRN_MODULE)");
  const auto& theirs = library.get<const AbiStamp>("cairn_abi_stamp");
  const AbiStamp ours = this_abi_stamp();
  if (theirs.magic != ours.magic || theirs.stamp_size != ours.stamp_size)
    throw PluginError(file.string() + ": its ABI stamp has another form; build it against cairn " + CAIRN_VERSION);
  if (std::memcmp(&theirs, &ours, sizeof(AbiStamp)) != 0)
    throw PluginError(file.string() + ": was built with another ABI.\n  module:  " + text_of(theirs) +
                      "\n  program: " + text_of(ours) + "\n  Build the module again against this program's headers.");
}

}  // namespace

LoadedPlugin load_plugin(const std::filesystem::path& file) {
  const std::shared_ptr<shared_library> library = open(file);
  check_stamp(file, *library);
  LoadedPlugin plugin;
  plugin.file = file;
  plugin.library = library;
  plugin.version = library->get<const AbiStamp>("cairn_abi_stamp").cairn_version;
  Registrar registrar;
  try {
    library->get<void(Registrar&)>("cairn_register_module")(registrar);
  } catch (const std::exception& error) {
    throw PluginError(file.string() + ": threw while registering: " + error.what());
  } catch (...) {
    throw PluginError(file.string() + ": threw something that is no std::exception while registering");
  }
  plugin.modules = registrar.modules();
  return plugin;
}

}  // namespace cairn
