// A bag of messages: MCAP (mcap.dev/spec, version 0), with chunks that are compressed by zstd, indexes and
// CRCs. What has been flushed can be read, whatever happens afterwards. Knows no disk and no kind of message.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace echoloop::bag {

/// What every file begins and ends with.
inline constexpr std::string_view mcap_magic("\x89MCAP0\r\n", 8);

class McapWriter {
  public:
    /// Takes the next bytes of the file.
    using Sink = std::function<void(std::string_view)>;

    /// Writes the header. `library`: who writes.
    McapWriter(Sink sink, const std::string& profile, const std::string& library);

    /// Their numbers, from 1. A schema or channel is written with its first message, in that one's chunk.
    std::uint16_t add_schema(const std::string& name, const std::string& encoding, const std::string& text);
    std::uint16_t add_channel(std::uint16_t schema, const std::string& topic, const std::string& encoding,
                              const std::map<std::string, std::string>& metadata = {});

    /// `time`: ns since 1970, when it was said; it is the time by which the file is sorted. Flushes where the
    /// chunk is large.
    void message(std::uint16_t channel, std::uint64_t time, std::string_view bytes);
    void attachment(const std::string& name, const std::string& media_type, std::uint64_t time,
                    std::string_view bytes);
    void metadata(const std::string& name, const std::map<std::string, std::string>& entries);
    /// Ends the chunk, if there is one.
    void flush();
    /// Ends the file.
    void finish();

    std::uint64_t messages() const { return messages_; }
    std::uint64_t size() const { return size_; }  ///< bytes given to the sink

  private:
    struct Entry {
        std::uint64_t time, offset;
    };
    struct Channel {
        std::string record;
        std::uint16_t schema;
        bool in_file = false;
        std::uint64_t messages = 0;
        std::vector<Entry> in_chunk{};
    };
    struct Schema {
        std::string record;
        bool in_file = false;
    };

    void put(std::string_view bytes);
    void introduce(Channel& channel);
    std::string summary();

    Sink sink_;
    std::uint64_t size_ = 0, messages_ = 0, first_ = 0, last_ = 0;
    std::uint32_t data_crc_ = 0;
    std::vector<Schema> schemas_;    ///< number less one
    std::vector<Channel> channels_;  ///< the same
    std::string chunk_;              ///< records, not yet compressed
    std::uint64_t chunk_first_ = 0, chunk_last_ = 0, chunk_messages_ = 0;
    std::string chunk_indexes_, attachment_indexes_, metadata_indexes_;  ///< records of the summary
    std::uint32_t chunks_ = 0, attachments_ = 0, metadata_ = 0;
};

}  // namespace echoloop::bag
