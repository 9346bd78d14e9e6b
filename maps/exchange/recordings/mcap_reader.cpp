#include "maps/exchange/recordings/mcap_reader.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "maps/exchange/recordings/mcap_compression.hpp"
#include "maps/exchange/recordings/mcap_fields.hpp"
#include "maps/exchange/recordings/mcap_records.hpp"

namespace cairn::exchange {
namespace {

constexpr std::uint64_t kMaxRecord = std::uint64_t{1} << 30U;
constexpr std::size_t kReadStep = std::size_t{1} << 20U;

// 0: the writer has left it out.
void check_crc(std::uint32_t said, std::uint32_t found, const std::string& of) {
  if (said != 0 && said != found) throw McapDamage("the checksum of " + of + " is wrong");
}

class Reader {
 public:
  Reader(const McapSource& source, const McapHandlers& handlers) : source_(source), handlers_(handlers) {}
  McapEnding read();

 private:
  struct Schema {
    std::string name;
    std::string encoding;
    std::string data;
  };
  struct Channel {
    std::uint16_t schema = 0;
    std::string topic;
    std::string encoding;
    bool is_reported = false;
  };

  bool fill(std::size_t count);
  bool read_record();
  void take_record(McapRecord kind, std::string_view content);
  void take_chunk(McapFields fields);
  void take_in_chunk(McapRecord kind, McapFields fields);
  void take_schema(McapFields fields);
  void take_channel(McapFields fields);
  void take_message(McapFields fields);
  void take_attachment(McapFields fields);
  void take_footer(std::string_view content);
  void report(Channel& channel, std::uint16_t id);
  void damaged(const std::string& what) const {
    if (handlers_.damaged) handlers_.damaged(offset_, what);
  }

  const McapSource& source_;
  const McapHandlers& handlers_;
  std::string buffer_;        // of the record at offset_, from its kind on
  std::uint64_t offset_ = 0;  // of the record under way
  std::uint32_t crc_ = 0;     // of all before it; from the summary on of the summary
  bool is_in_summary_ = false;
  bool is_ended_ = false;  // by a footer
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::set<std::uint16_t> unknown_;
};

// So that the buffer holds that many bytes. Memory grows with what is there, not with what a length says.
bool Reader::fill(std::size_t count) {
  while (buffer_.size() < count) {
    const std::size_t before = buffer_.size();
    const std::size_t wanted = std::min(count - before, kReadStep);
    buffer_.resize(before + wanted);
    const std::size_t got = source_(buffer_.data() + before, wanted);
    buffer_.resize(before + got);
    if (got < wanted) return false;
  }
  return true;
}

McapEnding Reader::read() {
  if (!fill(kMcapMagic.size()) || buffer_ != kMcapMagic)
    throw McapError("this is no MCAP file: it does not begin as one");
  crc_ = crc32_of(buffer_);
  offset_ = buffer_.size();
  while (!is_ended_)
    if (!read_record()) return McapEnding::cut;
  buffer_.clear();
  return fill(kMcapMagic.size()) && buffer_ == kMcapMagic ? McapEnding::whole : McapEnding::cut;
}

bool Reader::read_record() {
  constexpr std::size_t kHead = 1 + sizeof(std::uint64_t);
  buffer_.clear();
  if (!fill(kHead)) return false;
  const std::uint64_t length = McapFields(std::string_view(buffer_).substr(1)).u64();
  if (length > kMaxRecord) {
    damaged("a record of " + std::to_string(length) + " bytes; those up to 1 GiB can be read");
    return false;
  }
  if (!fill(kHead + length)) return false;
  const auto kind = static_cast<McapRecord>(buffer_[0]);
  const bool is_data_end = kind == McapRecord::data_end;
  try {
    take_record(kind, std::string_view(buffer_).substr(kHead));
  } catch (const McapDamage& damage) {
    damaged(damage.what());
  }
  crc_ = is_data_end ? 0 : crc32_of(buffer_, crc_);
  offset_ += buffer_.size();
  is_in_summary_ = is_in_summary_ || is_data_end;
  return true;
}

void Reader::take_record(McapRecord kind, std::string_view content) {
  if (kind == McapRecord::footer) return take_footer(content);
  if (is_in_summary_) return;  // what was there before once more
  if (kind == McapRecord::chunk) return take_chunk(McapFields(content));
  if (kind == McapRecord::attachment) return take_attachment(McapFields(content));
  if (kind == McapRecord::data_end) return check_crc(McapFields(content).u32(), crc_, "all data before this place");
  take_in_chunk(kind, McapFields(content));
}

void Reader::take_chunk(McapFields fields) {
  (void)fields.take(2 * sizeof(std::uint64_t));  // its first and last time
  const std::uint64_t size = fields.u64();
  const std::uint32_t crc = fields.u32();
  const std::string_view compression = fields.text();
  const std::string_view packed = fields.take(fields.u64());
  if (size > kMaxRecord)
    throw McapDamage("a chunk that unpacks to " + std::to_string(size) + " bytes; those up to 1 GiB can be read");
  const std::string records = unpacked(compression, packed, size, handlers_.look);
  check_crc(crc, crc32_of(records), "a chunk");
  std::size_t looked = 0;
  for (McapFields inside(records); !inside.is_at_end();) {
    const auto kind = static_cast<McapRecord>(inside.u8());
    take_in_chunk(kind, McapFields(inside.take(inside.u64())));
    if (!handlers_.look || inside.before().size() - looked < kReadStep) continue;
    looked = inside.before().size();
    handlers_.look();
  }
}

void Reader::take_in_chunk(McapRecord kind, McapFields fields) {
  if (kind == McapRecord::schema) take_schema(fields);
  if (kind == McapRecord::channel) take_channel(fields);
  if (kind == McapRecord::message) take_message(fields);
}

void Reader::take_schema(McapFields fields) {
  const std::uint16_t id = fields.u16();
  Schema schema;
  schema.name = fields.text();
  schema.encoding = fields.text();
  schema.data = fields.text();
  schemas_[id] = std::move(schema);
}

void Reader::take_channel(McapFields fields) {
  const std::uint16_t id = fields.u16();
  Channel channel;
  channel.schema = fields.u16();
  channel.topic = fields.text();
  channel.encoding = fields.text();
  const auto known = channels_.find(id);
  if (known != channels_.end() && known->second.topic == channel.topic && known->second.schema == channel.schema &&
      known->second.encoding == channel.encoding)
    return;
  channels_[id] = std::move(channel);
}

void Reader::report(Channel& channel, std::uint16_t id) {
  if (channel.is_reported) return;
  channel.is_reported = true;
  static const Schema kNone;
  const auto found = schemas_.find(channel.schema);
  const Schema& schema = found == schemas_.end() ? kNone : found->second;
  if (handlers_.channel)
    handlers_.channel({id, channel.topic, channel.encoding, schema.name, schema.encoding, schema.data});
}

void Reader::take_message(McapFields fields) {
  McapMessage message;
  message.channel = fields.u16();
  (void)fields.u32();  // its number in the channel
  message.log_time_ns = fields.u64();
  message.publish_time_ns = fields.u64();
  message.data = fields.rest();
  message.offset = offset_;
  const auto channel = channels_.find(message.channel);
  if (channel == channels_.end()) {
    if (unknown_.insert(message.channel).second)
      damaged("messages of channel " + std::to_string(message.channel) + ", which no record has introduced");
    return;
  }
  report(channel->second, message.channel);
  if (handlers_.message) handlers_.message(message);
}

void Reader::take_attachment(McapFields fields) {
  (void)fields.take(2 * sizeof(std::uint64_t));
  McapAttachment attachment;
  attachment.name = fields.text();
  attachment.media_type = fields.text();
  attachment.data = fields.take(fields.u64());
  const std::uint32_t found = crc32_of(fields.before());
  check_crc(fields.u32(), found, "an attachment");
  if (handlers_.attachment) handlers_.attachment(attachment);
}

// Its checksum is of the summary and of the footer up to it.
void Reader::take_footer(std::string_view content) {
  is_ended_ = true;
  McapFields fields(content);
  (void)fields.take(2 * sizeof(std::uint64_t));
  const std::string_view covered = std::string_view(buffer_).substr(0, buffer_.size() - fields.rest().size());
  check_crc(fields.u32(), crc32_of(covered, crc_), "the summary");
}

}  // namespace

McapEnding read_mcap(const McapSource& source, const McapHandlers& handlers) {
  return Reader(source, handlers).read();
}

McapEnding read_mcap(std::string_view file, const McapHandlers& handlers) {
  return read_mcap(
      [&](char* to, std::size_t count) {
        const std::size_t got = std::min(count, file.size());
        std::memcpy(to, file.data(), got);
        file.remove_prefix(got);
        return got;
      },
      handlers);
}

}  // namespace cairn::exchange
