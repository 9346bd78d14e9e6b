// Python's interpreter runs in the program's own process: a file that ends the process, crashes or hangs as it is
// imported would end what does not even need it. So it is imported in a process of its own first.
#pragma once

#include <string>

#include "framework/config/config_value.hpp"

namespace cairn::python_module {

// Once a sound file in each process, by the interpreter that start_interpreter() starts; where Python runs already
// (cairn.run) nothing is tried. What the file raises does not matter here. CAIRN_MODULE_TRIAL_S: so many seconds at
// most; 10 otherwise, for packages that take long to import. Throws ConfigError at that place.
void try_import(const std::string& file, const SourcePlace& place);

}  // namespace cairn::python_module
