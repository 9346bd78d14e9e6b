// Starting the `cairn` program from a test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cairn::testing_program {

struct Finished {
  int exit_status = -1;
  std::string out;
  std::string err;
};

// Runs build/.../bin/cairn with these arguments, standard input empty.
Finished run_cairn(const std::vector<std::string>& arguments);

// The same, and sends SIGINT after the first line has come out.
Finished interrupt_cairn(const std::vector<std::string>& arguments);

// A fresh, empty folder for one test.
std::filesystem::path fresh_folder(const std::string& name);
std::string text_of_file(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);
std::string source_folder();

}  // namespace cairn::testing_program
