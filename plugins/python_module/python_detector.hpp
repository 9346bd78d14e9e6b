// A detector written in Python. Plugin `python`, kind detector.
#pragma once

#include <vector>

#include "framework/contracts/detector.hpp"
#include "plugins/python_module/python_object.hpp"

namespace cairn::python_module {

class PythonDetector : public Detector {
 public:
  PythonDetector(const Config& config, const DetectorContext& context);
  // Calls detect(grid, changes) of the class when cells within the grid have changed.
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) override;

 private:
  void keep(const CellChanges& changes, const CellBox& bounds);
  void examine(const OccupancyGrid& grid, const Budget& budget);

  PythonObject object_;
  std::vector<CellSpan> changed_;  // not shown to Python yet
  std::vector<Matching> waiting_;  // more than a budget allowed
};

}  // namespace cairn::python_module
