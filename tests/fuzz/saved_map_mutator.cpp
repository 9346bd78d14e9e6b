// How the fuzzer of saved maps changes a file: mostly a field, with all checksums made anew, else any byte.
#include <random>

#include "tests/fuzz/map_file.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace cairn::fuzz {
namespace {

using Random = std::minstd_rand;

template <class List>
const auto& any_of(const List& list, Random& random) {
  return list[random() % std::size(list)];
}

// Numbers at which readers err.
std::string any_number(Random& random) {
  static constexpr const char* kNumbers[] = {"0",
                                             "1",
                                             "-1",
                                             "2",
                                             "64",
                                             "0.0",
                                             "-0.0",
                                             "0.5",
                                             "1e-320",
                                             "1e308",
                                             "-1e308",
                                             "9e999",
                                             "3.2",
                                             "2147483647",
                                             "2147483648",
                                             "-2147483648",
                                             "4503599627370496",
                                             "9007199254740991",
                                             "9007199254740992",
                                             "9223372036854775807",
                                             "-9223372036854775808",
                                             "1000000",
                                             "524288",
                                             "NULL",
                                             "''",
                                             "'text'",
                                             "x'00'",
                                             "zeroblob(4097)",
                                             "'{\"a\": 1}'",
                                             "'{\"a\": [[[[1]]]}'",
                                             "'0.5'",
                                             "'0,0 1,0 0,1'",
                                             "'0,0 1,0 0,1;3,3 4,3 3,4'",
                                             "'1e309,nan'"};
  return any_of(kNumbers, random);
}

std::string mutated(std::string bytes, std::size_t room) {
  const std::size_t size = bytes.size();
  bytes.resize(size + room);
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
  return bytes;
}

struct Field {
  std::string table;
  std::string column;
  std::string where;  // of one row
};

std::string where_of_any_row(MapFile& map, const std::string& table, Random& random) {
  const auto counts = map.column("SELECT count(*) FROM \"" + table + "\"");
  const auto keys = map.column("SELECT name FROM pragma_table_info('" + table + "') WHERE pk > 0 ORDER BY pk");
  if (counts.empty() || counts.front() == "0" || keys.empty()) return {};
  std::string list;
  for (const std::string& key : keys) list += (list.empty() ? "" : ", ") + key;
  return " WHERE (" + list + ") = (SELECT " + list + " FROM \"" + table + "\" LIMIT 1 OFFSET " +
         std::to_string(random() % std::stoull(counts.front())) + ")";
}

// A blob's content, packed again if it was, with its checksum in the column behind it.
void change_blob(MapFile& map, const Field& field) {
  const std::string stored = map.blob("SELECT " + field.column + " FROM \"" + field.table + "\"" + field.where);
  // A trajectory says with its first byte how it is stored; tiles begin as zlib does.
  const bool is_steps = stored.starts_with('\1');
  const bool is_doubles = stored.starts_with('\0');
  std::string raw = mutated(is_steps ? stored : unpacked(is_doubles ? stored.substr(1) : stored), 24);
  const std::string blob = is_steps ? raw : is_doubles ? '\0' + packed(raw) : packed(raw);
  if (is_doubles) raw = blob;  // which its checksum is over
  map.execute_with_blob("UPDATE \"" + field.table + "\" SET " + field.column + " = ?" + field.where, blob);
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(raw.data()), static_cast<uInt>(raw.size()));
  map.execute("UPDATE \"" + field.table + "\" SET crc32 = " + std::to_string(sum) + field.where);
}

void change_field(MapFile& map, const Field& field, Random& random) {
  const std::string set = "UPDATE OR IGNORE \"" + field.table + "\" SET " + field.column + " = ";
  switch (random() % 4) {
    case 0:
      map.execute(set + any_number(random) + field.where);
      break;
    case 1:  // another row's
      map.execute(set + "(SELECT " + field.column + " FROM \"" + field.table + "\"" +
                  where_of_any_row(map, field.table, random) + ")" + field.where);
      break;
    case 2:
      map.execute(set + field.column + " + " + any_number(random) + field.where);
      break;
    default: {
      const std::string text =
          mutated(map.blob("SELECT CAST(" + field.column + " AS BLOB) FROM \"" + field.table + "\"" + field.where), 16);
      map.execute_with_blob(set + "CAST(? AS TEXT)" + field.where, text);
    }
  }
}

void change(MapFile& map, Random& random) {
  const auto tables = map.column("SELECT name FROM sqlite_schema WHERE type = 'table' AND name <> 'checksums'");
  if (tables.empty()) return;
  Field field{any_of(tables, random), "", ""};
  const auto columns = map.column("SELECT name FROM pragma_table_info('" + field.table + "')");
  field.where = where_of_any_row(map, field.table, random);
  if (columns.empty()) return;
  field.column = any_of(columns, random);
  if (field.where.empty() || random() % 16 == 0) {  // a new row
    std::string values;
    for (std::size_t i = 0; i < columns.size(); ++i) values += (values.empty() ? "" : ", ") + any_number(random);
    map.execute("INSERT OR IGNORE INTO \"" + field.table + "\" VALUES (" + values + ")");
  } else if (random() % 16 == 0) {
    map.execute("DELETE FROM \"" + field.table + "\"" + field.where);
  } else if (field.column == "log_odds" || field.column == "trajectory") {
    change_blob(map, field);
  } else {
    change_field(map, field, random);
  }
}

}  // namespace
}  // namespace cairn::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  using namespace cairn::fuzz;
  Random random(seed);
  if (random() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  MapFile map({data, size});
  if (!map.is_open()) return LLVMFuzzerMutate(data, size, max_size);
  map.execute("PRAGMA synchronous = OFF; PRAGMA journal_mode = OFF");
  for (auto changes = 1 + random() % 3; changes > 0; --changes) change(map, random);
  map.sum_up();
  const std::string bytes = map.bytes();
  if (bytes.empty() || bytes.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}
