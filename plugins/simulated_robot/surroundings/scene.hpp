// The world as sound and a bumper meet it: straight faces, round faces and the vertices between.
//
// Walls and objects are built once from a World. What moves is a few faces behind them, changed from tick to
// tick; nothing of the rest is built anew for it. All in the map frame.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "framework/contracts/world.hpp"

namespace cairn {

inline constexpr int kFixed = -1;

struct Face {
  Point a_m;
  Point b_m;
  Point normal;  // unit; the side does not matter
  bool rough = false;
  int mover = kFixed;  // which moving thing it belongs to
};

struct RoundFace {
  Point centre_m;
  double radius_m = 0.0;
  bool rough = false;
  int mover = kFixed;
};

// How a vertex looks from some side: only a square inner corner of smooth faces sends a beam back.
enum class VertexLook { edge, square_corner, nothing };

// An end of one or more faces.
struct Vertex {
  struct Arm {
    double bearing_rad;  // direction of a face that leaves the vertex, in (-pi, pi]
    bool rough;
  };
  Point at_m;
  std::vector<Arm> arms;  // ascending bearing

  [[nodiscard]] VertexLook look_from(const Point& eye_m) const;
};

struct RayHit {
  double distance_m = std::numeric_limits<double>::infinity();
  Point normal{0.0, 0.0};  // unit, against the ray
  bool rough = false;
  double round_radius_m = 0.0;  // 0: a straight face
};

// Rays from one place, step_rad from each to the next.
struct RayFan {
  Point from_m;
  double first_rad = 0.0;
  double step_rad = 0.0;
  double reach_m = 0.0;
};

class Scene {
 public:
  // Of the world's walls and objects; its doors and movers are for show().
  explicit Scene(const World& world);

  // Shows the outline of a moving thing (its number from 0) shifted by so much. Linear in the outline.
  void show(const Scene& outline, const Point& shift_m, int mover);
  // Takes away all that show() has added.
  void clear_moving();

  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<RoundFace>& round_faces() const { return round_faces_; }
  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }

  // The first face on a ray of unit direction, nearer than reach_m. Linear in the faces.
  [[nodiscard]] RayHit cast(const Point& from_m, const Point& direction, double reach_m) const;
  // The same of a fan of rays: each one's distance, infinity where it meets nothing. A face costs only the rays that
  // look at it.
  void cast_fan(const RayFan& fan, std::span<double> distances_m) const;
  // Nothing between the two points; a face that passes through the target itself does not count.
  [[nodiscard]] bool sees(const Point& from_m, const Point& target_m) const;

 private:
  void add_face(const Point& a_m, const Point& b_m, bool rough);
  void collect_vertices();

  std::vector<Face> faces_;
  std::vector<RoundFace> round_faces_;
  std::vector<Vertex> vertices_;
  std::size_t fixed_faces_ = 0;
  std::size_t fixed_round_faces_ = 0;
  std::size_t fixed_vertices_ = 0;
};

}  // namespace cairn
