// Data packets as other firmware may write them: with sections that nobody here knows, or in another order.
// Never looks into a section.
#pragma once

#include <optional>

#include "protocols/wire/bytes.h"

namespace echoloop::r2sonic {

/// The same datagram with the sections that its packet is known for, in the order that readers walk, and with
/// its true size; nothing if it has that form already or its sections' sizes do not fit it. The maker lets
/// parsers skip by name and size; the PacketSize of SNI0 and TPX0 may be 0.
std::optional<wire::Bytes> known_sections(wire::ByteView datagram);

}  // namespace echoloop::r2sonic
