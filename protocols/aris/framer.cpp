#include "protocols/aris/framer.h"

namespace echoloop::aris {
namespace {

using wire::ByteView;

constexpr std::size_t shortest_command = 2;  // a type

std::uint32_t length_of(ByteView bytes) {
    return wire::load<wire::ByteOrder::big, std::uint32_t>(bytes.data());
}

/// Whether a command may begin here, as far as there are bytes.
bool may_begin(ByteView bytes) {
    for (std::size_t i = 0; i < 2 && i < bytes.size(); ++i)
        if (bytes[i] != 0) return false;
    if (bytes.size() < length_bytes) return true;
    return length_of(bytes) >= shortest_command && length_of(bytes) <= longest_command;
}

bool is_there(ByteView bytes) {
    return bytes.size() >= length_bytes && bytes.size() - length_bytes >= length_of(bytes);
}

/// The command that begins here, if it is there to its end.
std::optional<Command> whole(ByteView bytes) {
    if (!may_begin(bytes) || !is_there(bytes)) return std::nullopt;
    return parse_command(bytes.subspan(length_bytes, length_of(bytes)));
}

/// Where a whole command begins behind the first byte; 0 if none does.
std::size_t whole_behind(ByteView bytes) {
    for (std::size_t at = 1; at + length_bytes < bytes.size(); ++at)
        if (whole(bytes.subspan(at))) return at;
    return 0;
}

}  // namespace

wire::Found<Command> CommandFinder::find(ByteView pending, bool finished) const {
    if (auto command = whole(pending)) return {0, length_bytes + length_of(pending), std::move(command)};
    const bool waits = may_begin(pending) && !is_there(pending);
    return {waits && !finished ? whole_behind(pending) : 1};
}

}  // namespace echoloop::aris
