// The row of Water Linked's DVLs in the table of families. Never used by devices.
#pragma once

#include "protocols/inspect.h"

namespace echoloop::waterlinked {

/// Objects of JSON, sentences, PD6 lines and PD4 blocks, with noise between them.
std::vector<inspect::Message> decode(wire::ByteView bytes);
/// A sentence or a block whose checksum fits, a PD6 line, or an object that says its format or a command.
bool recognise(wire::ByteView bytes);
std::vector<wire::Table> tables();
wire::Bytes rewritten(wire::ByteView bytes);
std::vector<ChecksumPlace> checksums(wire::ByteView bytes);

/// Whether a line without its end is one of PD6 or PD13, which Teledyne's logs write as well.
bool is_pd6(std::string_view line);
/// What it holds.
void add_pd6(inspect::Message& out, std::string_view line);
std::vector<wire::Table> pd6_tables();

}  // namespace echoloop::waterlinked
