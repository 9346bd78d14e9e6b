// Reads recordings by the specification (https://mcap.dev/spec) and by nothing of the writer's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;

// Little-endian fields, one after the other. Throws std::out_of_range at the end.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  template <class Number>
  Number number() {
    Number value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
  std::string_view take(std::size_t count) {
    if (count > bytes_.size() - at_) throw std::out_of_range("a field reaches beyond its record");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size(); }
  [[nodiscard]] std::size_t at() const { return at_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));  // NOLINT
}

struct ReadRecording {
  std::map<std::uint16_t, std::string> schemas;
  std::map<std::uint16_t, std::uint16_t> schema_of;            // by channel
  std::map<std::uint16_t, std::string> topics;                 // by channel
  std::map<std::string, std::vector<std::string>> messages;    // by topic
  std::map<std::string, std::vector<std::uint64_t>> times_ns;  // by topic
  std::map<std::string, std::string> attachments;              // by name
  std::size_t count = 0;
  int chunks = 0;
  std::optional<std::uint64_t> count_said;  // by the statistics
  bool is_whole = false;                    // up to the magic at its end
};

void read_records(Fields& records, ReadRecording& read);

void read_chunk(Fields chunk, ReadRecording& read) {
  (void)chunk.take(16);
  const auto size = chunk.number<std::uint64_t>();
  const auto crc = chunk.number<std::uint32_t>();
  EXPECT_EQ(chunk.text(), "zstd");
  const std::string_view packed = chunk.take(chunk.number<std::uint64_t>());
  std::string records(size, '\0');
  ASSERT_EQ(ZSTD_decompress(records.data(), records.size(), packed.data(), packed.size()), size);
  EXPECT_EQ(crc_of(records), crc);
  ++read.chunks;
  Fields inside(records);
  read_records(inside, read);
}

void read_message(Fields message, ReadRecording& read) {
  const std::string& topic = read.topics.at(message.number<std::uint16_t>());
  EXPECT_EQ(message.number<std::uint32_t>(), read.messages[topic].size()) << "the sequence of " << topic;
  read.times_ns[topic].push_back(message.number<std::uint64_t>());
  (void)message.number<std::uint64_t>();
  std::string content;
  while (!message.is_at_end()) content += message.take(1);
  read.messages[topic].push_back(content);
  ++read.count;
}

void read_attachment(std::string_view bytes, ReadRecording& read) {
  Fields attachment(bytes);
  (void)attachment.take(16);
  const std::string name(attachment.text());
  (void)attachment.text();
  read.attachments[name] = attachment.take(attachment.number<std::uint64_t>());
  const std::uint32_t crc = crc_of(bytes.substr(0, attachment.at()));
  EXPECT_EQ(crc, attachment.number<std::uint32_t>()) << name;
}

void read_record(std::uint8_t kind, std::string_view bytes, ReadRecording& read) {
  Fields fields(bytes);
  if (kind == 3) {
    const auto id = fields.number<std::uint16_t>();
    (void)fields.text();
    (void)fields.text();
    read.schemas[id] = fields.text();
  } else if (kind == 4) {
    const auto id = fields.number<std::uint16_t>();
    read.schema_of[id] = fields.number<std::uint16_t>();
    read.topics[id] = fields.text();
  } else if (kind == 5) {
    read_message(fields, read);
  } else if (kind == 6) {
    read_chunk(fields, read);
  } else if (kind == 9) {
    read_attachment(bytes, read);
  } else if (kind == 11) {
    read.count_said = fields.number<std::uint64_t>();
  }
}

// Up to the end, or to a record that is cut off.
void read_records(Fields& records, ReadRecording& read) {
  try {
    while (!records.is_at_end()) {
      const auto kind = records.number<std::uint8_t>();
      read_record(kind, records.take(records.number<std::uint64_t>()), read);
      if (kind == 2) {
        read.is_whole = records.take(8) == std::string_view("\x89MCAP0\r\n", 8) && records.is_at_end();
        return;
      }
    }
  } catch (const std::out_of_range&) {
  }
}

ReadRecording read_recording(const std::string& bytes) {
  ReadRecording read;
  Fields records(bytes);
  EXPECT_EQ(records.take(8), std::string_view("\x89MCAP0\r\n", 8));
  read_records(records, read);
  return read;
}

Finished explore_office(const std::filesystem::path& out, std::vector<std::string> settings) {
  std::vector<std::string> arguments{"run",   source_folder() + "/config/missions/office.yaml",
                                     "--set", "steps.0.explore.at_most_s=25",
                                     "--out", out.string()};
  for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
  return run_cairn(arguments);
}

// x, y and heading of a geometry_msgs/PoseStamped in CDR.
std::array<double, 3> pose_of_cdr(const std::string& bytes) {
  constexpr std::size_t kEncoding = 4;
  Fields fields(std::string_view(bytes).substr(kEncoding));
  (void)fields.take(8);
  EXPECT_EQ(fields.text(), std::string_view("map\0", 4));
  (void)fields.take((8 - fields.at() % 8) % 8);
  const auto x_m = fields.number<double>();
  const auto y_m = fields.number<double>();
  (void)fields.take(3 * sizeof(double));
  const auto sin = fields.number<double>();
  const auto cos = fields.number<double>();
  EXPECT_TRUE(fields.is_at_end());
  return {x_m, y_m, 2.0 * std::atan2(sin, cos)};
}

class McapRecordingTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    out_ = new std::filesystem::path(fresh_folder("mcap"));
    const Finished run = explore_office(*out_, {"record_mcap=run.mcap"});
    bytes_ = new std::string(text_of_file(*out_ / "run.mcap"));
    ASSERT_GT(bytes_->size(), 1000U) << run.err;
  }
  static void TearDownTestSuite() {
    delete out_;
    delete bytes_;
  }
  static std::filesystem::path* out_;
  static std::string* bytes_;
};
std::filesystem::path* McapRecordingTest::out_ = nullptr;
std::string* McapRecordingTest::bytes_ = nullptr;

TEST_F(McapRecordingTest, HoldsTheRunWithChecksumsThatAreRight) {
  const ReadRecording read = read_recording(*bytes_);
  EXPECT_TRUE(read.is_whole);
  EXPECT_GT(read.chunks, 2);
  EXPECT_EQ(read.count_said, read.count);
  for (const char* topic : {"/pose", "/transform", "/truth", "/ranges", "/map", "/tree", "/log", "/ros/pose", "/tf"})
    EXPECT_TRUE(read.messages.contains(topic)) << topic;
  EXPECT_EQ(read.attachments.at("report.json"), text_of_file(*out_ / "report.json"));
  EXPECT_TRUE(read.attachments.at("office.cairn") == text_of_file(*out_ / "office.cairn"));
  EXPECT_EQ(read.attachments.at("office.yaml"), text_of_file(source_folder() + "/config/missions/office.yaml"));
  for (const auto& [topic, times_ns] : read.times_ns) EXPECT_TRUE(std::ranges::is_sorted(times_ns)) << topic;
}

TEST_F(McapRecordingTest, EveryJsonMessageHasTheFieldsOfItsSchema) {
  const ReadRecording read = read_recording(*bytes_);
  int seen = 0;
  for (const auto& [channel, topic] : read.topics) {
    const json schema = json::parse(read.schemas.at(read.schema_of.at(channel)), nullptr, false);
    if (schema.is_discarded()) continue;  // ros2msg
    for (const std::string& text : read.messages.at(topic)) {
      const json message = json::parse(text, nullptr, false);
      ASSERT_FALSE(message.is_discarded()) << topic << ": " << text;
      for (const auto& [key, value] : message.items())
        ASSERT_TRUE(schema["properties"].contains(key)) << topic << ": " << key;
      for (const json& key : schema.value("required", json::array()))
        ASSERT_TRUE(message.contains(key.get<std::string>())) << topic << ": " << key;
      ++seen;
    }
  }
  EXPECT_GT(seen, 1000);
}

TEST_F(McapRecordingTest, Ros2sPosesAreTheJsonOnes) {
  const ReadRecording read = read_recording(*bytes_);
  const auto& texts = read.messages.at("/pose");
  const auto& poses = read.messages.at("/ros/pose");
  ASSERT_EQ(texts.size(), poses.size());
  for (std::size_t i = 0; i < texts.size(); i += 50) {
    const json pose = json::parse(texts[i])["pose"];
    const auto [x_m, y_m, theta_rad] = pose_of_cdr(poses[i]);
    EXPECT_EQ(pose["position"]["x"].get<double>(), x_m);
    EXPECT_EQ(pose["position"]["y"].get<double>(), y_m);
    EXPECT_NEAR(2.0 * std::atan2(pose["orientation"]["z"].get<double>(), pose["orientation"]["w"].get<double>()),
                theta_rad, 1e-12);
  }
}

TEST_F(McapRecordingTest, CutOffAnywhereItIsReadableUpToItsLastChunk) {
  const ReadRecording whole = read_recording(*bytes_);
  for (const std::size_t percent : {5U, 40U, 60U, 90U}) {
    const ReadRecording cut = read_recording(bytes_->substr(0, bytes_->size() * percent / 100));
    EXPECT_FALSE(cut.is_whole);
    EXPECT_LE(cut.chunks, whole.chunks);
    for (const auto& [topic, messages] : cut.messages)
      EXPECT_TRUE(std::ranges::equal(messages, std::span(whole.messages.at(topic)).first(messages.size()))) << topic;
  }
  EXPECT_GT(read_recording(bytes_->substr(0, bytes_->size() / 2)).count, 100U);
}

TEST_F(McapRecordingTest, ASeedGivesItsBytesAgainAndTheRunIsTheSameWithoutIt) {
  const auto again = fresh_folder("mcap_again");
  const auto without = fresh_folder("mcap_without");
  (void)explore_office(again, {"record_mcap=run.mcap"});
  (void)explore_office(without, {});
  EXPECT_TRUE(text_of_file(again / "run.mcap") == *bytes_);
  for (const char* file : {"report.json", "office.cairn", "map.png"})
    EXPECT_TRUE(text_of_file(*out_ / file) == text_of_file(without / file)) << file << " differs";
}

TEST(McapRecording, WithTheNameOfTheOtherRecordingIsRefusedWithItsPlace) {
  const auto out = fresh_folder("mcap_names");
  const Finished run = explore_office(out, {"record=run.log", "record_mcap=run.log"});
  EXPECT_EQ(run.exit_status, 2);
  EXPECT_THAT(run.err, testing::HasSubstr("record_mcap: \"run.log\" is what `record` writes; each needs its own file"));
}

TEST(McapRecording, AFileThatCannotBeWrittenIsReportedBeforeTheRun) {
  const auto out = fresh_folder("mcap_nowhere");
  std::filesystem::create_directories(out / "run.mcap");
  const Finished run = explore_office(out, {"record_mcap=run.mcap"});
  EXPECT_NE(run.exit_status, 0);
  EXPECT_THAT(run.err, testing::HasSubstr("run.mcap: the recording cannot be written"));
  EXPECT_FALSE(std::filesystem::exists(out / "office.cairn"));
}

}  // namespace
}  // namespace cairn::testing_program
