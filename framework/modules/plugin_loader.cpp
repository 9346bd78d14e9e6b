#include "framework/modules/plugin_loader.hpp"

#include <fcntl.h>
#include <gelf.h>
#include <unistd.h>

#include <algorithm>
#include <boost/dll/shared_library.hpp>
#include <cstring>
#include <deque>
#include <exception>
#include <mutex>

#include "maps/base/printable.hpp"

namespace cairn {
namespace {

using boost::dll::shared_library;

constexpr const char* kStampSymbol = "cairn_abi_stamp";
constexpr const char* kRegisterSymbol = "cairn_register_module";

// An ELF file, open for reading.
class ElfFile {
 public:
  explicit ElfFile(const std::filesystem::path& file) : fd_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (fd_ >= 0 && ::elf_version(EV_CURRENT) != EV_NONE) elf_ = ::elf_begin(fd_, ELF_C_READ, nullptr);
  }
  ElfFile(const ElfFile&) = delete;
  ElfFile& operator=(const ElfFile&) = delete;
  ~ElfFile() {
    ::elf_end(elf_);
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] bool is_shared_library() const {
    GElf_Ehdr header;
    return elf_ != nullptr && ::gelf_getehdr(elf_, &header) != nullptr && header.e_type == ET_DYN;
  }
  // What it defines for others: the dynamic symbols, which a stripped library keeps.
  [[nodiscard]] std::vector<std::string> exported_symbols() const {
    std::vector<std::string> names;
    for (Elf_Scn* section = ::elf_nextscn(elf_, nullptr); section != nullptr; section = ::elf_nextscn(elf_, section)) {
      GElf_Shdr header;
      if (::gelf_getshdr(section, &header) == nullptr || header.sh_type != SHT_DYNSYM) continue;
      Elf_Data* const data = ::elf_getdata(section, nullptr);
      GElf_Sym symbol;
      for (int i = 0; data != nullptr && ::gelf_getsym(data, i, &symbol) != nullptr; ++i) {
        const char* const name = ::elf_strptr(elf_, header.sh_link, symbol.st_name);
        if (symbol.st_shndx != SHN_UNDEF && name != nullptr) names.emplace_back(name);
      }
    }
    return names;
  }

 private:
  int fd_;
  Elf* elf_ = nullptr;
};

// Reads the file's symbol table; runs nothing of it.
void check_symbols(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) throw PluginError(file, "is a folder; --plugins takes folders");
  if (!std::filesystem::is_regular_file(file))
    throw PluginError(file, std::filesystem::exists(file) ? "is not a plain file" : "no such file");
  const ElfFile elf(file);
  if (!elf.is_shared_library())
    throw PluginError(file, "cannot be opened as a module: it is not an ELF shared library");
  const std::vector<std::string> symbols = elf.exported_symbols();
  for (const char* symbol : {kStampSymbol, kRegisterSymbol})
    if (std::find(symbols.begin(), symbols.end(), symbol) == symbols.end())
      throw PluginError(file, std::string("is not a Cairn module (it exports no ") + symbol +
                                  "; end its module.cpp with CAIRN_MODULE)");
}

// Never unloaded: exceptions, type information and thread-local objects of a module may outlive all
// that was made from it.
const shared_library& open(const std::filesystem::path& file) {
  static std::mutex mutex;
  static auto& kept = *new std::deque<shared_library>;
  shared_library library;
  try {
    library.load(boost::dll::fs::path(std::filesystem::absolute(file).string()),
                 boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local);
  } catch (const std::exception& error) {
    throw PluginError(file, "cannot be opened as a module: " + printable_excerpt(error.what(), 1000));
  }
  const std::lock_guard lock(mutex);
  return kept.emplace_back(std::move(library));
}

void check_stamp(const std::filesystem::path& file, const shared_library& library) {
  const auto& theirs = library.get<const AbiStamp>(kStampSymbol);
  const AbiStamp ours = this_abi_stamp();
  if (theirs.magic != ours.magic || theirs.stamp_size != ours.stamp_size)
    throw PluginError(file, "its ABI stamp has another form; build it against cairn " CAIRN_VERSION);
  if (std::memcmp(&theirs, &ours, sizeof(AbiStamp)) != 0)
    throw PluginError(file, "was built with another ABI.\n  module:  " + text_of(theirs) + "\n  program: " +
                                text_of(ours) + "\n  Build the module again against this program's headers.");
}

}  // namespace

LoadedPlugin load_plugin(const std::filesystem::path& file, const std::function<void()>& before_registering) {
  check_symbols(file);
  const shared_library& library = open(file);
  check_stamp(file, library);
  LoadedPlugin plugin;
  plugin.file = file;
  plugin.stamp = library.get<const AbiStamp>(kStampSymbol);
  Registrar registrar;
  if (before_registering) before_registering();
  try {
    library.get<void(Registrar&)>(kRegisterSymbol)(registrar);
  } catch (const std::exception& error) {
    throw PluginError(file, "threw while registering: " + printable_excerpt(error.what()));
  } catch (...) {
    throw PluginError(file, "threw something that is no std::exception while registering");
  }
  plugin.modules = registrar.modules();
  return plugin;
}

}  // namespace cairn
