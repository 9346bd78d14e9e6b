// The Python interpreter of this process: the one that runs it, or one of our own.
#pragma once

#include <string>

namespace cairn::python_module {

// Starts Python unless it runs already, and leaves its lock released. Once; from any thread. Ours installs no signal
// handlers, hashes without a random seed, prints to the standard error, writes no byte code and never ends. It looks
// for packages where /usr/bin/python3 does, in PYTHONPATH, and in the virtual environment that is active. Throws
// std::runtime_error when it cannot start.
void start_interpreter();

// The interpreter's program: that of the virtual environment that is active, if its version is ours; else the system's.
[[nodiscard]] std::string python_program();

}  // namespace cairn::python_module
