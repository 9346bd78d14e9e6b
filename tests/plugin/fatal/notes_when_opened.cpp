// A good module that adds its process number to the file that CAIRN_TEST_NOTES names, wherever it is opened, and fails
// there when CAIRN_TEST_FATAL is set. It reads its standard input.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "framework/contracts/module.hpp"

namespace {

int note_process() {
  if (std::getenv("CAIRN_TEST_FATAL") != nullptr) std::abort();
  if (const char* file = std::getenv("CAIRN_TEST_NOTES")) std::ofstream(file, std::ios::app) << ::getpid() << "\n";
  return std::getchar();
}

const int kNoted = note_process();

class NotedLocalizer : public cairn::Localizer {
 public:
  cairn::PoseEstimate update(const cairn::Observation&, const cairn::KnownMap&) override { return {}; }
};

void register_module(cairn::Registrar& registrar) {
  (void)kNoted;
  registrar.add<cairn::Localizer, cairn::NoConfig>(
      "noted_localizer", "does nothing",
      [](const cairn::NoConfig&, const cairn::LocalizerContext&) { return std::make_unique<NotedLocalizer>(); });
}

}  // namespace

CAIRN_MODULE(register_module)
