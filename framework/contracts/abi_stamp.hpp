// What must agree between the host and a module before one may call the other.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>

#include "framework/contracts/behaviour.hpp"
#include "framework/contracts/controller.hpp"
#include "framework/contracts/detector.hpp"
#include "framework/contracts/localizer.hpp"
#include "framework/contracts/loop_closer.hpp"
#include "framework/contracts/mapper.hpp"
#include "framework/contracts/marker_detector.hpp"
#include "framework/contracts/path_planner.hpp"
#include "framework/contracts/planner.hpp"
#include "framework/contracts/registrar.hpp"
#include "framework/contracts/route_planner.hpp"
#include "framework/contracts/sensor.hpp"
#include "framework/contracts/world.hpp"

#define CAIRN_VERSION "0.1.0"

namespace cairn {

struct AbiStamp {
  std::uint32_t magic;       // kAbiMagic
  std::uint32_t stamp_size;  // sizeof(AbiStamp)
  char cairn_version[16];
  char compiler[48];
  char build[16];  // "release", "debug"
  std::uint32_t eigen_align;
  std::uint32_t contracts;  // kContractsVersion
  std::uint32_t sizes[39];  // of the exchanged types, as this_abi_stamp() lists them
};

// Raised whenever the signature of an interface or an exchanged type changes: sizes need not show that.
inline constexpr std::uint32_t kContractsVersion = 10;
inline constexpr std::uint32_t kAbiMagic = 0x4341524e;  // "CARN"

namespace abi_detail {
template <std::size_t N>
constexpr void copy(char (&out)[N], std::string_view text) {
  for (std::size_t i = 0; i < N; ++i) out[i] = i < text.size() && i + 1 < N ? text[i] : '\0';
}
}  // namespace abi_detail

[[nodiscard]] constexpr AbiStamp this_abi_stamp() {
  AbiStamp stamp{};
  stamp.magic = kAbiMagic;
  stamp.stamp_size = sizeof(AbiStamp);
  abi_detail::copy(stamp.cairn_version, CAIRN_VERSION);
#if defined(__clang__)
  abi_detail::copy(stamp.compiler, "clang " __clang_version__);
#else
  abi_detail::copy(stamp.compiler, "gcc " __VERSION__);
#endif
#if defined(NDEBUG)
  abi_detail::copy(stamp.build, "release");
#else
  abi_detail::copy(stamp.build, "debug");
#endif
  stamp.eigen_align = EIGEN_MAX_ALIGN_BYTES;
  stamp.contracts = kContractsVersion;
  const std::uint32_t sizes[] = {
      sizeof(Observation),   sizeof(RangeReading),     sizeof(PoseEstimate),
      sizeof(KnownMap),      sizeof(OccupancyGrid),    sizeof(LandmarkGraph),
      sizeof(PlanResult),    sizeof(PlanRequest),      sizeof(PathResult),
      sizeof(PathRequest),   sizeof(PlannerTraits),    sizeof(RouteResult),
      sizeof(RouteRequest),  sizeof(RouteEnd),         sizeof(DetectionReport),
      sizeof(Matching),      sizeof(WorldView),        sizeof(RobotModel),
      sizeof(World),         sizeof(RegisteredModule), sizeof(FieldSpec),
      sizeof(ModuleContext), sizeof(SensorContext),    sizeof(LocalizerContext),
      sizeof(MapperContext), sizeof(DetectorContext),  sizeof(BehaviourFactoryContext),
      sizeof(Status),        sizeof(ControlRequest),   sizeof(ControlResult),
      sizeof(CameraImage),   sizeof(MarkerSighting),   sizeof(CameraModel),
      sizeof(LoopQuery),     sizeof(LoopProposal),     sizeof(PassedSubmap),
      sizeof(Submap),        sizeof(MapMove),          sizeof(KeptSubmaps),
  };
  static_assert(sizeof sizes == sizeof stamp.sizes);
  for (std::size_t i = 0; i < std::size(sizes); ++i) stamp.sizes[i] = sizes[i];
  return stamp;
}

// "cairn 0.1.0, gcc 12.2.0, release, Eigen alignment 16, sizes ..."
[[nodiscard]] std::string text_of(const AbiStamp& stamp);

}  // namespace cairn
