// A tree as a PNG: boxes from left to right, children to the right of their parent.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cairn {

enum class BoxKind : std::uint8_t { branch, wrapper, question, action };

struct TreeBox {
  std::string title;
  std::string detail{};  // a second line, or empty; cut when it is long
  BoxKind kind = BoxKind::action;
  std::vector<TreeBox> children{};
};

inline constexpr std::size_t kMaxPictureRows = 400;  // boxes without children

// Throws std::runtime_error with the file and the reason: the tree has too many rows, or the file cannot be written.
void write_tree_picture(const std::filesystem::path& file, const TreeBox& root, const std::string& title,
                        const std::string& subtitle);

}  // namespace cairn
