#include "maps/exchange/recordings/mcap_writer.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <span>
#include <stdexcept>

#include "maps/exchange/recordings/mcap_records.hpp"

namespace cairn::exchange {

std::uint32_t crc32_of(std::string_view bytes, std::uint32_t begin) {
  return static_cast<std::uint32_t>(
      crc32_z(begin, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));  // NOLINT: what zlib takes
}

namespace {

template <class Unsigned>
void add_number(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xFF);
}

void add_sized(std::string& bytes, std::string_view text) {
  add_number(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

// The content of one record, put together field by field.
class Fields {
 public:
  Fields& u8(std::uint8_t value) { return number(value); }
  Fields& u16(std::uint16_t value) { return number(value); }
  Fields& u32(std::uint32_t value) { return number(value); }
  Fields& u64(std::uint64_t value) { return number(value); }
  Fields& text(std::string_view value) {
    add_sized(bytes_, value);
    return *this;
  }
  Fields& bytes(std::string_view value) {
    bytes_ += value;
    return *this;
  }
  Fields& map(const std::map<std::uint16_t, std::uint64_t>& values) {
    u32(static_cast<std::uint32_t>(values.size() * (sizeof(std::uint16_t) + sizeof(std::uint64_t))));
    for (const auto& [key, value] : values) u16(key).u64(value);
    return *this;
  }
  [[nodiscard]] const std::string& content() const { return bytes_; }
  [[nodiscard]] std::string record(McapRecord kind) const {
    std::string record(1, static_cast<char>(kind));
    add_number(record, static_cast<std::uint64_t>(bytes_.size()));
    return record + bytes_;
  }

 private:
  template <class Unsigned>
  Fields& number(Unsigned value) {
    add_number(bytes_, value);
    return *this;
  }
  std::string bytes_;
};

std::string_view name_of(McapCompression compression) {
  return compression == McapCompression::zstd ? "zstd" : "";
}

template <class Map>
std::uint16_t next_id(const Map& known) {
  if (known.size() >= std::numeric_limits<std::uint16_t>::max())
    throw std::length_error("MCAP: more than 65535 schemas or channels");
  return static_cast<std::uint16_t>(known.size() + 1);
}

// The records of the summary, and where each kind of them lies in the file.
struct Summary {
  std::uint64_t begin = 0;
  std::string bytes{};
  std::string offsets{};

  void add(McapRecord kind, std::string_view records) {
    if (records.empty()) return;
    offsets += Fields()
                   .u8(static_cast<std::uint8_t>(kind))
                   .u64(begin + bytes.size())
                   .u64(records.size())
                   .record(McapRecord::summary_offset);
    bytes += records;
  }
};

std::string joined(std::span<const std::string> records) {
  std::string all;
  for (const std::string& record : records) all += record;
  return all;
}

template <class Map>
std::string records_of(const Map& known) {
  std::string all;
  for (const auto& [id, entry] : known)
    if (entry.is_written) all += entry.record;
  return all;
}

template <class Map>
std::size_t count_written(const Map& known) {
  return static_cast<std::size_t>(
      std::ranges::count_if(known, [](const auto& entry) { return entry.second.is_written; }));
}

}  // namespace

void McapWriter::Span::add(std::uint64_t time_ns) {
  first_ns = messages == 0 ? time_ns : std::min(first_ns, time_ns);
  last_ns = std::max(last_ns, time_ns);
  ++messages;
}

McapWriter::McapWriter(Sink sink, McapOptions options) : sink_(std::move(sink)), options_(std::move(options)) {
  put(kMcapMagic);
  put(Fields().text(options_.profile).text(options_.library).record(McapRecord::header));
}

McapWriter::Ids McapWriter::add_schema(std::string_view name, std::string_view encoding, std::string_view data) {
  const Ids id = next_id(schemas_);
  schemas_[id].record = Fields().u16(id).text(name).text(encoding).text(data).record(McapRecord::schema);
  return id;
}

McapWriter::Ids McapWriter::add_channel(std::string_view topic, Ids schema, std::string_view encoding) {
  const Ids id = next_id(channels_);
  Channel& channel = channels_[id];
  channel.schema = schema;
  channel.record = Fields().u16(id).u16(schema).text(topic).text(encoding).u32(0).record(McapRecord::channel);
  return id;
}

void McapWriter::write(Ids channel_id, std::uint64_t time_ns, std::string_view message) {
  Channel& channel = channels_.at(channel_id);
  introduce(channel);
  channel.in_chunk.emplace_back(time_ns, chunk_.size());
  chunk_ += Fields()
                .u16(channel_id)
                .u32(channel.messages++)
                .u64(time_ns)
                .u64(time_ns)
                .bytes(message)
                .record(McapRecord::message);
  chunk_span_.add(time_ns);
  file_span_.add(time_ns);
  const bool is_long = chunk_span_.last_ns - chunk_span_.first_ns >= options_.chunk_ns;
  if (is_long || chunk_.size() >= options_.chunk_bytes) end_chunk();
}

void McapWriter::attach(std::string_view name, std::string_view media_type, std::uint64_t time_ns,
                        std::string_view data) {
  end_chunk();
  Fields content;
  content.u64(time_ns).u64(0).text(name).text(media_type).u64(data.size()).bytes(data);
  const std::string record = content.u32(crc32_of(content.content())).record(McapRecord::attachment);
  attachment_indexes_.push_back(Fields()
                                    .u64(offset_)
                                    .u64(record.size())
                                    .u64(time_ns)
                                    .u64(0)
                                    .u64(data.size())
                                    .text(name)
                                    .text(media_type)
                                    .record(McapRecord::attachment_index));
  put(record);
}

void McapWriter::end_chunk() {
  if (chunk_.empty()) return;
  const std::string records = compressed();
  const std::string_view compression = name_of(options_.compression);
  const std::uint64_t begin = offset_;
  put(Fields()
          .u64(chunk_span_.first_ns)
          .u64(chunk_span_.last_ns)
          .u64(chunk_.size())
          .u32(crc32_of(chunk_))
          .text(compression)
          .u64(records.size())
          .bytes(records)
          .record(McapRecord::chunk));
  const std::uint64_t end = offset_;
  std::map<Ids, std::uint64_t> index_offsets;
  put_message_indexes(index_offsets);
  chunk_indexes_.push_back(Fields()
                               .u64(chunk_span_.first_ns)
                               .u64(chunk_span_.last_ns)
                               .u64(begin)
                               .u64(end - begin)
                               .map(index_offsets)
                               .u64(offset_ - end)
                               .text(compression)
                               .u64(records.size())
                               .u64(chunk_.size())
                               .record(McapRecord::chunk_index));
  chunk_.clear();
  chunk_span_ = {};
}

void McapWriter::close() {
  end_chunk();
  put(Fields().u32(crc_).record(McapRecord::data_end));
  Summary summary{offset_};
  summary.add(McapRecord::schema, records_of(schemas_));
  summary.add(McapRecord::channel, records_of(channels_));
  summary.add(McapRecord::statistics, statistics());
  summary.add(McapRecord::chunk_index, joined(chunk_indexes_));
  summary.add(McapRecord::attachment_index, joined(attachment_indexes_));
  const std::uint64_t offsets_begin = summary.begin + summary.bytes.size();
  Fields footer;
  footer.u64(summary.begin).u64(offsets_begin);
  // The checksum covers the footer up to itself: opcode, length and both offsets.
  constexpr std::size_t kCrcBytes = sizeof(std::uint32_t);
  std::string begun = Fields(footer).u32(0).record(McapRecord::footer);
  begun.resize(begun.size() - kCrcBytes);
  const std::string covered = summary.bytes + summary.offsets + begun;
  put(summary.bytes + summary.offsets + footer.u32(crc32_of(covered)).record(McapRecord::footer));
  put(kMcapMagic);
}

void McapWriter::put(std::string_view bytes) {
  crc_ = crc32_of(bytes, crc_);
  offset_ += bytes.size();
  sink_(bytes);
}

void McapWriter::put_message_indexes(std::map<Ids, std::uint64_t>& offsets) {
  for (auto& [id, channel] : channels_) {
    if (channel.in_chunk.empty()) continue;
    offsets[id] = offset_;
    Fields index;
    index.u16(id).u32(static_cast<std::uint32_t>(channel.in_chunk.size() * 2 * sizeof(std::uint64_t)));
    for (const auto& [time_ns, offset] : channel.in_chunk) index.u64(time_ns).u64(offset);
    put(index.record(McapRecord::message_index));
    channel.in_chunk.clear();
  }
}

// Schema and channel go before their first message, so that a reader needs nothing that comes later.
void McapWriter::introduce(Channel& channel) {
  if (channel.is_written) return;
  if (channel.schema != 0) {
    Schema& schema = schemas_.at(channel.schema);
    if (!schema.is_written) chunk_ += schema.record;
    schema.is_written = true;
  }
  chunk_ += channel.record;
  channel.is_written = true;
}

std::string McapWriter::compressed() const {
  if (options_.compression == McapCompression::none) return chunk_;
  constexpr int kFast = 1;
  std::string packed(ZSTD_compressBound(chunk_.size()), '\0');
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), chunk_.data(), chunk_.size(), kFast);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(std::string("MCAP: zstd: ") + ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

std::string McapWriter::statistics() const {
  std::map<Ids, std::uint64_t> messages;
  for (const auto& [id, channel] : channels_)
    if (channel.is_written) messages[id] = channel.messages;
  return Fields()
      .u64(file_span_.messages)
      .u16(static_cast<std::uint16_t>(count_written(schemas_)))
      .u32(static_cast<std::uint32_t>(count_written(channels_)))
      .u32(static_cast<std::uint32_t>(attachment_indexes_.size()))
      .u32(0)
      .u32(static_cast<std::uint32_t>(chunk_indexes_.size()))
      .u64(file_span_.first_ns)
      .u64(file_span_.last_ns)
      .map(messages)
      .record(McapRecord::statistics);
}

}  // namespace cairn::exchange
