// Grids going out to other tools, as a user sees them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/exchange/grids/grey_picture.hpp"
#include "maps/store/map_store.hpp"
#include "tests/scenario/maps/map_files.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class MapExport : public MapFiles {
 protected:
  MapExport() : MapFiles("map_export") {}
  void SetUp() override { save("m.cairn", drawn_map({"#..?", "....", "##.?"}, {-1.0, 2.0})); }
};

TEST_F(MapExport, AGridGoesOutToMapServerAndComesBack) {
  const OccupancyGrid grid = map("m.cairn").grid;
  for (const char* const mode : {"trinary", "scale", "raw"}) {
    const json reported = done({"export", file("m.cairn"), "-o", file("out.yaml"), "--mode", mode});
    EXPECT_EQ(reported["file"], file("out.yaml"));
    EXPECT_EQ(reported["warnings"],
              (json{file("out.yaml") + ": 1 landmark, 0 routes: not written, the file holds the grid only"}));
    done({"import", file("out.yaml"), "-o", file("again.cairn")});
    EXPECT_TRUE(map("again.cairn").grid == grid) << mode;
  }
  EXPECT_EQ(text_of_file(file("out.yaml")),
            "image: out.pgm\nmode: raw\nresolution: 0.05\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST_F(MapExport, ThePictureIsAsAsked) {
  for (const auto& [format, begin] : {std::pair{"pgm", "P5"}, {"png", "\x89PNG"}, {"bmp", "BM"}}) {
    done({"export", file("m.cairn"), "-o", file("out.yaml"), "--picture", format});
    EXPECT_TRUE(text_of_file(file("out.") + format).starts_with(begin));
    EXPECT_THAT(text_of_file(file("out.yaml")), HasSubstr(std::string("image: out.") + format + "\n"));
  }
  EXPECT_THAT(
      done({"export", file("m.cairn"), "-o", file("s.yaml"), "--mode", "scale", "--picture", "pgm"})["warnings"][0],
      HasSubstr("PGM holds no transparency"));
  done({"export", file("m.cairn"), "-o", file("s.yaml"), "--mode", "scale"});
  EXPECT_TRUE(std::filesystem::exists(file("s.png")));
}

TEST_F(MapExport, APlainPictureHasSoManyPixelsACell) {
  for (const auto& [scale, width, height] : {std::tuple{"3", 12, 9}, {"1", 4, 3}, {"0.5", 2, 2}, {"0.01", 1, 1}}) {
    done({"export", file("m.cairn"), "-o", file("p.png"), "--scale", scale});
    const GreyPicture picture = parse_grey_picture(text_of_file(file("p.png")), "p.png");
    EXPECT_EQ(picture.width, width);
    EXPECT_EQ(picture.height, height);
  }
}

TEST_F(MapExport, OptionsThatDoNotFitAreRefused) {
  EXPECT_EQ(refused({"export", file("m.cairn"), "-o", "a.png", "--mode", "raw"}),
            "cairn: map export: --mode is for map_server files (*.yaml); the file to write is a.png\n");
  EXPECT_EQ(refused({"export", file("m.cairn"), "-o", "a.graph", "--scale", "2"}),
            "cairn: map export: --scale is for pictures (*.png); the file to write is a.graph\n");
  EXPECT_THAT(refused({"export", file("m.cairn"), "-o", file("a.yaml"), "--mode", "tri"}), HasSubstr("trinary"));
  EXPECT_THAT(refused({"export", file("m.cairn"), "-o", file("a.yaml"), "--picture", "jpg"}), HasSubstr("pgm"));
  for (const char* const scale : {"nan", "-1", "0", "1e9"})
    EXPECT_THAT(refused({"export", file("m.cairn"), "-o", file("a.png"), "--scale", scale}),
                HasSubstr("must be a number from 1e-06 to 65536"));
  EXPECT_EQ(refused({"export", file("m.cairn"), "-o", file("a.png"), "--scale", "20000"}),
            "cairn: map export: a scale of 20000 makes 80000 x 60000 pixels of 4 x 3 cells, possible are 65536 a side "
            "and 67108864 in all\n");
  for (const char* const name : {"a.yaml", "a.png", "a.pgm"}) EXPECT_FALSE(std::filesystem::exists(file(name)));
}

TEST_F(MapExport, AMapWithoutAGridAndOneThatIsNotThereAreRefused) {
  SavedMap map;
  map.graph.add({});
  save("g.cairn", map);
  EXPECT_EQ(refused({"export", file("g.cairn"), "-o", file("a.yaml")}),
            "cairn: " + file("g.cairn") +
                ": holds no grid; map_server files are of grids, *.nav.yaml of landmarks and routes\n");
  EXPECT_EQ(refused({"export", file("g.cairn"), "-o", file("a.png"), "--scale", "1"}),
            "cairn: " + file("g.cairn") + ": holds no grid; without --scale its landmarks and routes are drawn\n");
  EXPECT_THAT(refused({"export", file("none.cairn"), "-o", file("a.yaml")}), HasSubstr("none.cairn"));
}

TEST_F(MapExport, AnOpenRmfGraphComesInAndGoesOut) {
  write_text(file("0.yaml"),
             "building_name: lab\nlevels:\n  L1:\n    vertices: [[0, 0, {name: dock, is_charger: true}], [3, 4]]\n"
             "    lanes: [[0, 1, {speed_limit: 0.5}], [1, 0]]\ndoors: {}\nlifts: {}\n");
  const json reported = done({"import", file("0.yaml"), "-o", file("g.cairn")});
  EXPECT_EQ(reported["landmarks"], 2);
  EXPECT_EQ(reported["routes"], 2);
  EXPECT_EQ(done({"export", file("g.cairn"), "-o", file("out.nav.yaml")})["warnings"], json::array());
  EXPECT_TRUE(text_of_file(file("out.nav.yaml")).starts_with("building_name: lab\nlevels:\n  L1:\n"));
  done({"import", file("out.nav.yaml"), "-o", file("again.cairn")});
  EXPECT_EQ(map("again.cairn").graph, map("g.cairn").graph);
  write_text(file("bad.yaml"), "levels: {L1: {vertices: [[0, 0]], lanes: [[0, 1]]}}\n");
  EXPECT_EQ(refused({"import", file("bad.yaml"), "-o", file("b.cairn")}),
            "cairn: " + file("bad.yaml") + ":1:47: there is no vertex 1: the level has 1, the first is 0\n");
  save("empty.cairn", SavedMap());
  EXPECT_EQ(refused({"export", file("empty.cairn"), "-o", file("e.nav.yaml")}),
            "cairn: " + file("empty.cairn") + ": holds no landmark to make a vertex of\n");
}

TEST_F(MapExport, ThePictureNeverOverwritesTheMap) {
  save("m.pgm", map("m.cairn"));
  EXPECT_EQ(refused({"export", file("m.pgm"), "-o", file("m.yaml")}),
            "cairn: map export: the picture " + file("m.pgm") +
                " would overwrite the map that is exported; give -o another name\n");
  EXPECT_TRUE(map("m.pgm").grid == map("m.cairn").grid);
}

}  // namespace
}  // namespace cairn::testing_program
