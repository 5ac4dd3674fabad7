#include "tools/bag/mcap.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <stdexcept>

namespace echoloop::bag {
namespace {

constexpr std::size_t full_chunk = 1 << 20;  // bytes
constexpr int quick = 1;                     // of zstd's levels

enum Op : std::uint8_t {
    op_header = 0x01,
    op_footer = 0x02,
    op_schema = 0x03,
    op_channel = 0x04,
    op_message = 0x05,
    op_chunk = 0x06,
    op_message_index = 0x07,
    op_chunk_index = 0x08,
    op_attachment = 0x09,
    op_attachment_index = 0x0A,
    op_statistics = 0x0B,
    op_metadata = 0x0C,
    op_metadata_index = 0x0D,
    op_summary_offset = 0x0E,
    op_data_end = 0x0F,
};

std::uint32_t crc_of(std::string_view bytes, std::uint32_t before = 0) {
    return static_cast<std::uint32_t>(
        ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// Content of a record, little endian.
class Content {
  public:
    template <class T>
    Content& number(T value) {
        for (std::size_t i = 0; i < sizeof value; ++i)
            bytes_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFF);
        return *this;
    }
    Content& raw(std::string_view bytes) {
        bytes_ += bytes;
        return *this;
    }
    Content& text(std::string_view text) { return number(static_cast<std::uint32_t>(text.size())).raw(text); }
    Content& map(const std::map<std::string, std::string>& entries) {
        Content all;
        for (const auto& [key, value] : entries) all.text(key).text(value);
        return text(all.bytes_);
    }
    const std::string& bytes() const { return bytes_; }
    std::string record(Op op) const {
        return Content().number(static_cast<std::uint8_t>(op)).number(std::uint64_t{bytes_.size()}).bytes_ +
               bytes_;
    }

  private:
    std::string bytes_;
};

std::string compressed(std::string_view bytes) {
    std::string out(ZSTD_compressBound(bytes.size()), '\0');
    const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), quick);
    if (ZSTD_isError(size)) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
    out.resize(size);
    return out;
}

}  // namespace

McapWriter::McapWriter(Sink sink, const std::string& profile, const std::string& library)
    : sink_(std::move(sink)) {
    put(std::string(mcap_magic) + Content().text(profile).text(library).record(op_header));
}

void McapWriter::put(std::string_view bytes) {
    data_crc_ = crc_of(bytes, data_crc_);
    size_ += bytes.size();
    sink_(bytes);
}

std::uint16_t McapWriter::add_schema(const std::string& name, const std::string& encoding,
                                     const std::string& text) {
    const auto number = static_cast<std::uint16_t>(schemas_.size() + 1);
    schemas_.push_back({Content().number(number).text(name).text(encoding).text(text).record(op_schema)});
    return number;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema, const std::string& topic,
                                      const std::string& encoding,
                                      const std::map<std::string, std::string>& metadata) {
    const auto number = static_cast<std::uint16_t>(channels_.size() + 1);
    channels_.push_back(
        {Content().number(number).number(schema).text(topic).text(encoding).map(metadata).record(op_channel),
         schema});
    return number;
}

void McapWriter::introduce(Channel& channel) {
    if (channel.in_file) return;
    if (Schema& schema = schemas_[channel.schema - 1U]; !schema.in_file) {
        chunk_ += schema.record;
        schema.in_file = true;
    }
    chunk_ += channel.record;
    channel.in_file = true;
}

void McapWriter::message(std::uint16_t number, std::uint64_t time, std::string_view bytes) {
    Channel& channel = channels_[number - 1U];
    introduce(channel);
    if (chunk_messages_++ == 0) chunk_first_ = chunk_last_ = time;
    if (messages_++ == 0) first_ = last_ = time;
    chunk_first_ = std::min(chunk_first_, time), chunk_last_ = std::max(chunk_last_, time);
    first_ = std::min(first_, time), last_ = std::max(last_, time);
    channel.in_chunk.push_back({time, chunk_.size()});
    chunk_ += Content()
                  .number(number)
                  .number(static_cast<std::uint32_t>(channel.messages++))
                  .number(time)
                  .number(time)
                  .raw(bytes)
                  .record(op_message);
    if (chunk_.size() >= full_chunk) flush();
}

void McapWriter::flush() {
    if (chunk_.empty()) return;
    const std::string packed = compressed(chunk_);
    const std::string chunk = Content()
                                  .number(chunk_first_)
                                  .number(chunk_last_)
                                  .number(std::uint64_t{chunk_.size()})
                                  .number(crc_of(chunk_))
                                  .text("zstd")
                                  .number(std::uint64_t{packed.size()})
                                  .raw(packed)
                                  .record(op_chunk);
    std::string indexes;
    Content places;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
        auto& entries = channels_[i].in_chunk;
        if (entries.empty()) continue;
        const auto number = static_cast<std::uint16_t>(i + 1);
        std::ranges::stable_sort(entries, {}, &Entry::time);
        Content all;
        for (const Entry& entry : entries) all.number(entry.time).number(entry.offset);
        places.number(number).number(size_ + chunk.size() + indexes.size());
        indexes += Content().number(number).text(all.bytes()).record(op_message_index);
        entries.clear();
    }
    chunk_indexes_ += Content()
                          .number(chunk_first_)
                          .number(chunk_last_)
                          .number(size_)
                          .number(std::uint64_t{chunk.size()})
                          .text(places.bytes())
                          .number(std::uint64_t{indexes.size()})
                          .text("zstd")
                          .number(std::uint64_t{packed.size()})
                          .number(std::uint64_t{chunk_.size()})
                          .record(op_chunk_index);
    ++chunks_;
    chunk_.clear();
    chunk_messages_ = 0;
    put(chunk + indexes);  // at once: half of it would be lost
}

void McapWriter::attachment(const std::string& name, const std::string& media_type, std::uint64_t time,
                            std::string_view bytes) {
    Content content;
    content.number(time)
        .number(time)
        .text(name)
        .text(media_type)
        .number(std::uint64_t{bytes.size()})
        .raw(bytes);
    const std::string record = content.number(crc_of(content.bytes())).record(op_attachment);
    attachment_indexes_ += Content()
                               .number(size_)
                               .number(std::uint64_t{record.size()})
                               .number(time)
                               .number(time)
                               .number(std::uint64_t{bytes.size()})
                               .text(name)
                               .text(media_type)
                               .record(op_attachment_index);
    ++attachments_;
    put(record);
}

void McapWriter::metadata(const std::string& name, const std::map<std::string, std::string>& entries) {
    const std::string record = Content().text(name).map(entries).record(op_metadata);
    metadata_indexes_ +=
        Content().number(size_).number(std::uint64_t{record.size()}).text(name).record(op_metadata_index);
    ++metadata_;
    put(record);
}

/// All that stands between the data and the footer, and where its groups are.
std::string McapWriter::summary() {
    std::string out, offsets;
    const auto group = [&](Op op, const std::string& records) {
        if (records.empty()) return;
        offsets += Content()
                       .number(static_cast<std::uint8_t>(op))
                       .number(size_ + out.size())
                       .number(std::uint64_t{records.size()})
                       .record(op_summary_offset);
        out += records;
    };
    std::string schemas, channels;
    Content counts;
    std::uint16_t schema_count = 0;
    std::uint32_t channel_count = 0;
    for (const Schema& schema : schemas_)
        if (schema.in_file) schemas += schema.record, ++schema_count;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
        if (!channels_[i].in_file) continue;
        channels += channels_[i].record, ++channel_count;
        counts.number(static_cast<std::uint16_t>(i + 1)).number(channels_[i].messages);
    }
    group(op_schema, schemas);
    group(op_channel, channels);
    group(op_statistics, Content()
                             .number(messages_)
                             .number(schema_count)
                             .number(channel_count)
                             .number(attachments_)
                             .number(metadata_)
                             .number(chunks_)
                             .number(first_)
                             .number(last_)
                             .text(counts.bytes())
                             .record(op_statistics));
    group(op_chunk_index, chunk_indexes_);
    group(op_attachment_index, attachment_indexes_);
    group(op_metadata_index, metadata_indexes_);
    const std::uint64_t start = size_, offset_start = size_ + out.size();
    out += offsets;
    // The CRC of the summary goes over the footer, too, up to the CRC itself.
    out += Content()
               .number(static_cast<std::uint8_t>(op_footer))
               .number(std::uint64_t{20})
               .number(start)
               .number(offset_start)
               .bytes();
    return out + Content().number(crc_of(out)).bytes();
}

void McapWriter::finish() {
    flush();
    put(Content().number(data_crc_).record(op_data_end));
    put(summary());
    put(mcap_magic);
}

}  // namespace echoloop::bag
