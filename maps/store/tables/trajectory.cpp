#include "maps/store/tables/trajectory.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "maps/base/deflate.hpp"
#include "maps/landmarks/landmark_graph.hpp"
#include "maps/store/map_store.hpp"
#include "maps/store/tables/codec.hpp"

namespace cairn::store {
namespace {

constexpr std::size_t kPoseBytes = 3 * sizeof(double);  // of a pose as doubles
constexpr char kDoubles = 0;
constexpr char kSteps = 1;
constexpr double kMaxSteps = 9e15;  // below 2^53, so that each number of steps is a double of its own
constexpr std::array kParts{&Pose2::x_m, &Pose2::y_m, &Pose2::theta_rad};

using Steps = std::array<std::int64_t, 3>;

std::optional<std::int64_t> whole_steps(double value) {
  const double steps = std::round(value * kTrajectorySteps);
  if (!(std::abs(steps) <= kMaxSteps)) return std::nullopt;
  const auto whole = static_cast<std::int64_t>(steps);
  // Bit by bit, since -0.0 == 0.0.
  const double back = static_cast<double>(whole) / kTrajectorySteps;
  if (std::bit_cast<std::uint64_t>(back) != std::bit_cast<std::uint64_t>(value)) return std::nullopt;
  return whole;
}

// Seven bits a byte, the lowest first; the eighth says that more follow. Small numbers of either sign are short.
void append_number(std::string& bytes, std::int64_t value) {
  auto bits = (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
  for (; bits >= 0x80; bits >>= 7) bytes.push_back(static_cast<char>(0x80 | (bits & 0x7F)));
  bytes.push_back(static_cast<char>(bits));
}

std::int64_t take_number(const std::string& bytes, std::size_t& at) {
  std::uint64_t bits = 0;
  for (int shift = 0; shift < 63; shift += 7) {
    if (at >= bytes.size()) throw StoreError("its bytes end before its poses do");
    const auto byte = static_cast<unsigned char>(bytes[at++]);
    bits |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if (byte < 0x80) return static_cast<std::int64_t>(bits >> 1) ^ -static_cast<std::int64_t>(bits & 1);
  }
  throw StoreError("one of its numbers is too long");
}

std::optional<std::string> packed_steps(const std::vector<Pose2>& trajectory) {
  std::string packed(1, kSteps);
  Steps before{};
  for (const Pose2& pose : trajectory) {
    for (std::size_t part = 0; part < kParts.size(); ++part) {
      const std::optional<std::int64_t> steps = whole_steps(pose.*kParts[part]);
      if (!steps) return std::nullopt;
      append_number(packed, *steps - before[part]);
      before[part] = *steps;
    }
  }
  return packed;
}

std::vector<Pose2> unpacked_steps(const std::string& packed, std::size_t poses) {
  // Checked before the memory is asked for: each number takes a byte.
  if (packed.size() < 1 + poses * kParts.size()) throw StoreError("its bytes end before its poses do");
  std::vector<Pose2> trajectory(poses);
  Steps steps{};
  std::size_t at = 1;
  for (Pose2& pose : trajectory)
    for (std::size_t part = 0; part < kParts.size(); ++part) {
      steps[part] += take_number(packed, at);
      if (std::abs(static_cast<double>(steps[part])) > kMaxSteps) throw StoreError("one of its numbers is too large");
      pose.*kParts[part] = static_cast<double>(steps[part]) / kTrajectorySteps;
    }
  if (at != packed.size()) throw StoreError("more bytes follow its poses");
  return trajectory;
}

std::string doubles_of(const std::vector<Pose2>& trajectory) {
  std::string raw;
  for (const Pose2& pose : trajectory)
    for (double Pose2::*part : kParts) append_little_endian(raw, pose.*part);
  return raw;
}

std::vector<Pose2> trajectory_of_doubles(const std::string& raw) {
  std::vector<Pose2> trajectory(raw.size() / kPoseBytes);
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    for (std::size_t part = 0; part < kParts.size(); ++part)
      trajectory[i].*kParts[part] = little_endian_at<double>(raw, i * kPoseBytes + part * sizeof(double));
  return trajectory;
}

}  // namespace

std::string packed_trajectory(const std::vector<Pose2>& trajectory) {
  if (trajectory.empty()) return {};
  if (std::optional<std::string> steps = packed_steps(trajectory)) return *std::move(steps);
  return kDoubles + deflated(doubles_of(trajectory));
}

std::vector<Pose2> unpacked_trajectory(const std::string& packed, std::size_t poses) {
  if (packed.empty() && poses == 0) return {};
  if (packed.starts_with(kSteps)) return unpacked_steps(packed, poses);
  if (!packed.starts_with(kDoubles)) throw StoreError("its first byte is neither 0 nor 1");
  return trajectory_of_doubles(unpacked_bytes(packed.substr(1), poses * kPoseBytes));
}

}  // namespace cairn::store
