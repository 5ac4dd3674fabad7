// Bytes on the wires as named messages for the page, the pictures in them, and
// what drivers have set. Opens nothing; whatever the bytes hold, it says
// something.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "protocols/stream_decoder.h"
#include "tools/said/said.h"
#include "tools/view/feed.h"

namespace echoloop::view {

class Ticker {
  public:
    /// `families`: of the messages of each device, as protocols/inspect.h calls
    /// them.
    explicit Ticker(std::map<std::string, std::string> families) : families_(std::move(families)) {}

    struct Told {
        /// {"type": "messages", "left_out": bytes, "messages": [{"n", "unix",
        /// "device", "port", "sent", "size", "name", "reason", "parts": of its kind
        /// within 10 ms, where there are several, "fields":
        /// [[name, text, unit], ...], "fault": what was made on it, on those
        /// alone}], "said": the longest array of numbers in the last message of
        /// each kind that a device sent whose family has no pictures:
        /// [{"device", "name", "unit", "numbers"}], "set": as settings() tells
        /// them}; "" where there are none.
        std::string messages;
        std::vector<std::string> pictures;  ///< said_picture.h; of large ones the latest of each kind
    };
    /// `shown`: whether what a device says is on a screen; of others, and while
    /// `sparing`, a large picture is read once a second.
    Told take(const std::vector<Passed>& passed, const std::vector<bag::Fault>& faults, std::size_t left_out,
              bool sparing, const std::function<bool(const std::string& device)>& shown);

    /// {"type": "messages", "messages": [], "said": [], "set": [{"device",
    /// "name", "unix", "times", "fields", "changed": names of the fields that
    /// differ from the message of that name before}]}: the last of each kind of
    /// message that each driver has said.
    std::string settings() const;

  private:
    using Json = nlohmann::ordered_json;
    using Way = std::pair<std::string, bool>;  ///< port of a device, and direction

    /// Of messages that make large pictures, while these are worth a look a second.
    struct Rest {
        double next = 0;        ///< s since 1970, when they are read again
        bool skipped = false;   ///< some were not read since the last picture
        bool in_parts = false;  ///< and what was read then was a part of one
        std::set<std::string>
            known{};  ///< names of the pictures that they make: an EdgeTech's two frequencies
        std::set<std::string> told{};  ///< of those, what was read of late
    };

    struct Batch;
    void mark(const bag::Fault& fault, Json& rows);
    void decode(const Passed& one, Batch& batch);
    void add(const Passed& one, const inspect::Message& message, ByteView bytes, std::size_t size,
             Batch& batch);
    static bool is_part(const Passed& one, const inspect::Message& message, Batch& batch);
    void note_setting(const Passed& one, const Json& row, Batch& batch);
    void look_for_picture(const Passed& one, const inspect::Message& message, ByteView bytes, Batch& batch);
    void show(const Passed& one, const std::string& key, said::Picture picture, Batch& batch);

    std::map<std::string, std::string> families_;
    std::map<Way, std::unique_ptr<inspect::StreamDecoder>> streams_;
    std::map<std::string, std::unique_ptr<said::Maker>> makers_;  ///< by device
    std::map<std::string, std::uint64_t> pictures_;               ///< made so far, by device
    std::map<std::string, Rest> rests_;                           ///< by device and message
    std::map<std::string, Json> settings_;                        ///< by device and message
    std::uint64_t count_ = 0;
};

}  // namespace echoloop::view
