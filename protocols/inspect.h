// Bytes of a known protocol as named messages, for `echoloop inspect` and the documentation. One row per
// family in inspect.cpp; decodes bytes in memory, never reads files.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/checksums.h"
#include "protocols/wire/bytes.h"
#include "protocols/wire/table.h"
#include "protocols/wire/value.h"

namespace echoloop::inspect {

struct Field {
    std::string name{};  ///< "h0.sound_speed"
    std::string text{};  ///< for people; long arrays are cut
    std::string unit{};
    std::size_t offset = 0;  ///< from the start of the bytes given
    std::size_t size = 0;
    std::optional<double> number{};  ///< of a single number
    std::vector<double> numbers{};   ///< of an array
};

/// A message, or a span that could not be decoded: then `reason` says why.
struct Message {
    std::size_t offset = 0;  ///< from the start of the bytes given
    std::size_t size = 0;
    std::string name{};  ///< "HeadData"; empty for noise
    std::vector<Field> fields{};
    std::string reason{};  ///< empty if all was decoded
};

enum class Framing {
    stream,    ///< messages are found in a run of bytes, noise between them is skipped
    datagram,  ///< one call, one datagram
};

/// Where a family is met by default.
struct Places {
    std::string_view tcp{}, udp{};  ///< ports, as "4002,6020-6022"
    bool serial = false;            ///< serial lines
};

/// All that tools know of a family. tests/data/NAME holds its golden bytes, docs/messages-NAME.md its tables
/// and tools/echoloop/dissector/families/NAME.lua how Wireshark cuts its messages.
struct Family {
    std::string_view name;   ///< "seanet"
    std::string_view title;  ///< "Tritech SeaNet"
    Places places;
    Framing framing;
    /// All messages and undecoded spans in order; together they cover every byte.
    std::vector<Message> (*decode)(wire::ByteView bytes);
    /// True if the bytes hold at least one sure sign of the family.
    bool (*recognise)(wire::ByteView bytes);
    /// Every message and section of the family.
    std::vector<wire::Table> (*tables)();
    /// The one message that the bytes are, parsed and written back; empty if they are none.
    wire::Bytes (*rewritten)(wire::ByteView bytes);
    FindChecksums checksums = nullptr;  ///< nullptr: its messages have none
    /// Datagrams that come in parts: adds one to those of its kind in `held`; true if `held` is the whole
    /// now. nullptr: there are none.
    bool (*join)(wire::Bytes& held, wire::ByteView datagram) = nullptr;
    std::size_t longest_frame = std::size_t{66} << 10;  ///< B; of most families lengths are 16-bit
};

std::span<const Family> families();
/// nullptr if there is none of that name.
const Family* find_family(std::string_view name);
/// The first family that recognises the bytes; nullptr if none does.
const Family* guess_family(wire::ByteView bytes);

/// All message tables of a family as Markdown.
std::string markdown_tables(const Family& family);

/// A field of a message that starts at `start` of the bytes given.
Field to_field(const wire::FieldView& view, std::size_t start);

}  // namespace echoloop::inspect
