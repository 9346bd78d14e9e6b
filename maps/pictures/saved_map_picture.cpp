#include "maps/pictures/saved_map_picture.hpp"

namespace cairn {

MapPicture picture_of(const SavedMap& map) {
  MapPicture picture;
  picture.grid = &map.grid;
  picture.graph = &map.graph;
  picture.clusters = &map.clusters;
  picture.shapes = map.shapes;
  for (const Pose2& pose : map.driven_path) picture.driven.push_back(pose.position());
  return picture;
}

}  // namespace cairn
