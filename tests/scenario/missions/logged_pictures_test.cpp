// A log with a camera's pictures beside it, which are older than the scans: where a tag comes to be in the map.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "framework/files/robot_file.hpp"
#include "maps/store/map_store.hpp"
#include "plugins/simulated_robot/camera/cameras.hpp"
#include "tests/plugins/common/pictures/written_pictures.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

constexpr double kSpeed_mps = 0.5;

// A room of 8 x 8 m with tag 7 on its right wall.
World room_with_a_tag() {
  World world;
  world.max_m = {8.0, 8.0};
  world.walls = {{{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}}, Surface::smooth}};
  world.tags = {{{MarkerFamily::tag36h11, 7}, {8.0, 4.0, radians(180.0)}, 0.4, 0.16}};
  return world;
}

Pose2 robot_at(double stamp_s) {
  return {2.0 + kSpeed_mps * stamp_s, 3.8, 0.0};
}

std::string log_of_the_drive() {
  std::string log = "PARAM robot_frontlaser_offset 0 nohost 0\nPARAM robot_front_laser_max 20 nohost 0\n";
  for (double stamp_s = 0.0; stamp_s < 7.0; stamp_s += 0.4) {
    const Pose2 at = robot_at(stamp_s);
    const std::string pose = fmt::format("{:.3f} {:.3f} 0", at.x_m, at.y_m);
    log += fmt::format("FLASER 3 3.8 {:.3f} 4.2 {} {} {:.3f} robot {:.3f}\n", 8.0 - at.x_m, pose, pose, 100.0 + stamp_s,
                       100.0 + stamp_s);
  }
  return log;
}

// Each is taken in the middle between two scans.
void take_pictures(const std::filesystem::path& folder, const CameraModel& camera) {
  RobotModel robot;
  robot.cameras = {camera};
  const World world = room_with_a_tag();
  const Scene scene(world);
  Cameras cameras(robot, world, scene, 1);
  std::string list = "# stamp file\n";
  for (double stamp_s = 2.2; stamp_s < 6.5; stamp_s += 0.4) {
    std::vector<CameraImage> images;
    cameras.take(robot_at(stamp_s), stamp_s - 0.5 / camera.rate_hz, stamp_s + 0.5 / camera.rate_hz, images);
    ASSERT_FALSE(images.empty());
    const std::string name = fmt::format("{:.1f}.png", stamp_s);
    std::ofstream(folder / name, std::ios::binary)
        << written_pictures::png(camera.width_px, camera.height_px, *images.back().grey);
    list += fmt::format("{:.3f} {}\n", 100.0 + stamp_s, name);
  }
  write_text(folder / "list.txt", list);
}

// Of tag 7 in the map that the log and the pictures make; offset_s is added to their stamps.
Pose2 tag_of(const std::filesystem::path& out, double offset_s) {
  write_text(
      out / "drive.yaml",
      "mission: drive\nrobot: " + source_folder() + "/config/robots/pioneer3dx_camera.yaml\n" +
          "sensor: {plugin: picture_log, log: {plugin: carmen_log, file: drive.log}, pictures: [{list: list.txt, "
          "offset_s: " +
          fmt::format("{}", offset_s) +
          "}]}\nlocalizer: {plugin: odometry_compass}\nmap: {plugin: muriel}\n"
          "markers: {detector: {plugin: april_tags}}\n");
  const Finished run = run_cairn({"run", (out / "drive.yaml").string(), "--out", out.string()});
  EXPECT_EQ(run.exit_status, 0) << run.err << run.out;
  const SavedMap map = load_map((out / "drive.cairn").string());
  const Landmark* const tag = map.graph.find_marker({MarkerFamily::tag36h11, 7});
  EXPECT_NE(tag, nullptr) << run.out;
  return tag == nullptr ? Pose2{} : tag->T_map_landmark;
}

TEST(LoggedPictures, OfAMovingRobotPutATagWhereItIsByTheirStamps) {
  const auto out = fresh_folder("logged_pictures");
  write_text(out / "drive.log", log_of_the_drive());
  take_pictures(out, load_robot(source_folder() + "/config/robots/pioneer3dx_camera.yaml").cameras.at(0));
  const Pose2 right = tag_of(out, 0.0);
  EXPECT_NEAR(right.x_m, 8.0, 0.02);
  EXPECT_NEAR(right.y_m, 4.0, 0.02);
  const Pose2 wrong = tag_of(out, 0.2);
  EXPECT_NEAR(wrong.x_m, 8.0 + 0.2 * kSpeed_mps, 0.02) << "as if they were not old";
}

}  // namespace
}  // namespace cairn::testing_program
