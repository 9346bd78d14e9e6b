#include "maps/store/update.hpp"

#include <string>
#include <vector>

namespace cairn::store {
namespace {

// The file, under the name "kept" beside the wanted map, which is "main".
class Attached {
 public:
  Attached(const std::filesystem::path& file, Database& database) : database_(database) {
    Statement(database, "ATTACH ? AS kept").bind_text(std::filesystem::absolute(file).string()).run();
    // Nothing beside the file, no page twice, and what is deleted is not overwritten.
    database.execute(
        "PRAGMA kept.journal_mode = MEMORY; PRAGMA kept.synchronous = FULL; PRAGMA kept.secure_delete = OFF; "
        "PRAGMA cache_spill = OFF; PRAGMA temp_store = MEMORY");
  }
  Attached(const Attached&) = delete;
  Attached& operator=(const Attached&) = delete;
  ~Attached() {
    for (const char* const sql : {"ROLLBACK", "DETACH kept"}) {
      try {
        database_.execute(sql);
      } catch (const StoreError&) {
        // No transaction is open any more.
      }
    }
  }

 private:
  Database& database_;
};

struct Columns {
  std::vector<std::string> key;
  std::vector<std::string> others;
};

Columns columns_of(Database& database, const std::string& table) {
  Columns columns;
  Statement row(database, "SELECT name, pk FROM pragma_table_info(?) ORDER BY cid");
  row.bind_text(table);
  while (row.step()) (row.integer(1) > 0 ? columns.key : columns.others).push_back(row.text(0));
  return columns;
}

// The column's name behind both texts, for each.
std::string for_each(const std::vector<std::string>& columns, const std::string& separator, const std::string& before,
                     const std::string& between) {
  std::string text;
  for (const std::string& column : columns)
    text.append(text.empty() ? "" : separator).append(before).append(column).append(between).append(column);
  return text;
}

void update_table(Database& database, const std::string& table) {
  const Columns columns = columns_of(database, table);
  const std::string same_key = for_each(columns.key, " AND ", "o.", " = n.");
  const std::string same_rest = for_each(columns.others, " AND ", "o.", " IS n.");
  std::string key;
  for (const std::string& column : columns.key) key += (key.empty() ? "" : ", ") + column;
  database.execute("DELETE FROM kept." + table + " AS o WHERE NOT EXISTS (SELECT 1 FROM main." + table +
                   " AS n WHERE " + same_key + ")");
  // A row that has changed keeps its place in the file.
  database.execute("INSERT INTO kept." + table + " SELECT * FROM main." + table +
                   " AS n WHERE NOT EXISTS (SELECT 1 FROM kept." + table + " AS o WHERE " + same_key + " AND " +
                   same_rest + ") ON CONFLICT (" + key + ") DO UPDATE SET " +
                   for_each(columns.others, ", ", "", " = excluded."));
}

std::vector<std::string> names_of_tables(Database& database) {
  std::vector<std::string> names;
  Statement table(database, "SELECT name FROM main.sqlite_schema WHERE type = 'table'");
  while (table.step()) names.push_back(table.text(0));
  return names;
}

std::int64_t page_bytes_in(Database& database) {
  Statement size(database, "PRAGMA kept.page_size");
  size.step();
  return size.integer(0);
}

}  // namespace

std::uint64_t update_map_file(const std::filesystem::path& file, Database& wanted) {
  const Attached attached(file, wanted);
  const std::int64_t before = wanted.pages_written();
  wanted.execute("BEGIN IMMEDIATE");
  for (const std::string& table : names_of_tables(wanted)) update_table(wanted, table);
  wanted.execute("COMMIT");
  return static_cast<std::uint64_t>((wanted.pages_written() - before) * page_bytes_in(wanted));
}

}  // namespace cairn::store
