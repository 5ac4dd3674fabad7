// SeaNet messages to frames and back, by the tables of layouts.h. Knows no state, time or device.
#pragma once

#include <string>

#include "protocols/seanet/messages.h"
#include "protocols/wire/bytes.h"
#include "protocols/wire/result.h"

namespace echoloop::seanet {

/// Byte 9 of mtHeadData: sources and hosts disagree (0 is the safe one).
enum class HeadDataRemaining { zero, low_byte };

struct EncodeOptions {
    /// Receiver of a command, sender of a reply. Messages of a profiler are always those of node 20.
    std::uint8_t sonar_node = nodes::imaging;
    HeadDataRemaining head_data_remaining = HeadDataRemaining::zero;
};

/// The message in a frame. HeadCommand and HeadData of node 20 are a profiler's. Errors carry offsets from
/// the '@'. The sizes of the specification are enforced; byte 9, nodes and sequence are not looked at.
wire::Result<Message> parse(const Frame& frame);

/// Header and payload of a message; the direction follows from the message.
Frame make_frame(const Message& message, const EncodeOptions& options = {});

/// All bytes of a frame, '@' to LF. A payload beyond 65527 bytes is cut.
wire::Bytes encode(const Frame& frame);
wire::Bytes encode(const Message& message, const EncodeOptions& options = {});

Id id_of(const Message& message);
/// True for commands, which go from the host to the sonar.
bool from_host(const Message& message);
/// True for messages whose bytes mean what they say with node 20 only.
bool is_profiler(const Message& message);

/// "HeadData", or "id 99" for an id without a name.
std::string name_of(Id id);

/// One line for people: name, nodes, size, and either the fields or why they cannot be read.
std::string describe(const Frame& frame);

}  // namespace echoloop::seanet
