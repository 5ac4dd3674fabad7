// Imagenex messages and shots of files to bytes and back, by the tables of the layouts. Knows no state, time
// or device.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "protocols/imagenex/messages.h"
#include "protocols/imagenex/shot_files.h"
#include "protocols/wire/bytes.h"
#include "protocols/wire/result.h"

namespace echoloop::imagenex {

inline constexpr std::size_t command_bytes = 27;
inline constexpr std::size_t reply_overhead = 13;       ///< bytes of a reply beside its echo data
inline constexpr std::size_t pipe_reply_overhead = 33;  ///< of an 831L's

/// The message that these bytes are, all of them. A command for head 1F is the azimuth drive's.
wire::Result<Message> parse(wire::ByteView bytes);
/// A command for any head, 1F included.
wire::Result<SwitchCommand> parse_switch_command(wire::ByteView bytes);
wire::Bytes encode(const Message& message);

/// One shot of a file of any kind.
using FileShot = std::variant<Shot852, Shot81A, Shot31L>;
/// Errors carry offsets from the start of the shot. Index, total and reply must fit each other.
wire::Result<FileShot> parse_shot(wire::ByteView bytes);
wire::Bytes encode(const FileShot& shot);
/// Bytes of the shot that begins here, by its first 35 bytes; 0 if none can begin here, nothing if more bytes
/// must come first.
std::optional<std::size_t> shot_bytes(wire::ByteView bytes);

/// Echo data of a real reply: 0, 128, 250, 252, 500 or, of an 872, 1000 bytes.
bool is_legal_data_size(std::uint64_t bytes);

/// An 831L's: 250 bytes in an IMX, none in an IPX.
bool is_legal_pipe_data_size(std::uint8_t kind, std::uint64_t bytes);
/// Whether a reply with these second and fourth bytes is an 831L's: other heads have their id there.
constexpr bool is_of_831l(std::uint8_t kind, std::uint8_t type) {
    return (kind == 'M' || kind == 'P') && type <= 1;
}

/// "SwitchCommand", "IMX", "IAX", "IMX831L".
std::string name_of(const Message& message);

}  // namespace echoloop::imagenex
