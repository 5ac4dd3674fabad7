// What the text messages of Water Linked's DVLs hold, field by field: the tables that `inspect` and the
// documentation go by. Tables only.
#pragma once

#include <span>
#include <string_view>

namespace echoloop::waterlinked {

struct FieldRow {
    std::string_view name, unit, help;
    bool number = true;  ///< else characters
};

struct MessageRow {
    std::string_view name, help;
    std::span<const FieldRow> fields;
};

/// Objects of the JSON protocol by the names that they have here; their keys stand in this order.
std::span<const MessageRow> json_messages();
/// Sentences of the serial protocol, by their address.
std::span<const MessageRow> sentences();
/// Lines of PD6, by their two capitals.
std::span<const MessageRow> pd6_lines();

/// nullptr if there is none.
const MessageRow* find_row(std::span<const MessageRow> among, std::string_view name);

}  // namespace echoloop::waterlinked
