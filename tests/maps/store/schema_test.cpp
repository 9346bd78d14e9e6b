#include "maps/store/schema.hpp"

#include <array>

#include "tests/maps/store/store_fixture.hpp"

namespace cairn::store {
namespace {

constexpr std::array kSteps{"ALTER TABLE landmarks ADD COLUMN colour TEXT NOT NULL DEFAULT 'red'",
                            "UPDATE landmarks SET colour = colour || id; CREATE TABLE doors (id INTEGER PRIMARY KEY)"};

std::string first_colour(Database& database) {
  Statement row(database, "SELECT colour FROM landmarks ORDER BY id");
  return row.step() ? row.text(0) : "none";
}

TEST_F(MapStore, AnOlderMapGetsTheStepsThatItHasNotHadInTheirOrder) {
  save_map(file(), small_map());
  const std::string before = bytes_of(file());
  Database second = migrated(Database::read_only(file()), 1, std::span(kSteps).first(1));
  EXPECT_EQ(first_colour(second), "red");
  Database third = migrated(std::move(second), 2, kSteps);
  EXPECT_EQ(first_colour(third), "red1");
  Database both = migrated(Database::read_only(file()), 1, kSteps);
  EXPECT_EQ(first_colour(both), "red1");
  Database unchanged = Database::read_only(file());
  EXPECT_EQ(tables_of(both).size(), tables_of(unchanged).size() + 1);
  EXPECT_EQ(bytes_of(file()), before);
}

}  // namespace
}  // namespace cairn::store
