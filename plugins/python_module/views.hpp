// What Python sees of the host during a call: grid, changes, the world. Afterwards each use raises RuntimeError.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "framework/contracts/world_view.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn::python_module {

// Makes the classes known to Python, once. With the interpreter's lock.
void add_classes();

// How long what is lent may be used.
class Loan {
 public:
  Loan() = default;
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;
  ~Loan() { *is_open_ = false; }
  [[nodiscard]] std::shared_ptr<const bool> is_open() const { return is_open_; }

 private:
  std::shared_ptr<bool> is_open_ = std::make_shared<bool>(true);
};

template <class Value>
class Lent {
 public:
  Lent(Value& value, std::shared_ptr<const bool> is_open) : value_(&value), is_open_(std::move(is_open)) {}
  // Throws std::runtime_error after the call.
  [[nodiscard]] Value& get() const {
    if (!*is_open_) throw std::runtime_error("this can be used during the call only: copy what you keep");
    return *value_;
  }
  template <class Other>
  [[nodiscard]] Lent<Other> with(Other& other) const {
    return {other, is_open_};
  }

 private:
  Value* value_;
  std::shared_ptr<const bool> is_open_;
};

// A part of the grid, or the whole of it.
struct GridView {
  Lent<const OccupancyGrid> grid;
  CellBox shown;
  [[nodiscard]] const OccupancyGrid& cells() const { return grid.get(); }
  [[nodiscard]] CellBox box() const { return shown; }
};
[[nodiscard]] GridView whole_of(const Lent<const OccupancyGrid>& grid);

// Cells that may have changed, within the box of a grid's arrays.
struct ChangesView {
  std::vector<CellSpan> spans;
  CellBox shown;
};

struct WorldProxy {
  Lent<const WorldView> world;
};

}  // namespace cairn::python_module
