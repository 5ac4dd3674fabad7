// Messages as text for people, by their tables. Never prints to anything itself.
#pragma once

#include <string>

#include "protocols/wire/visit.h"

namespace echoloop::wire {

/// "name value unit", or "name value x unit" where the unit is a number of units ("0.01 K")
std::string field_text(const FieldView& field);

/// One line per field: offset, name, value, unit.
template <class M>
std::string print(const M& message) {
    std::string out(layout<M>.name);
    out += '\n';
    visit_fields(message, [&](const FieldView& field) {
        const std::string offset = std::to_string(field.offset);
        out.append(offset.size() < 6 ? 6 - offset.size() : 0, ' ');
        out.append(offset).append("  ").append(field_text(field)).append("\n");
    });
    return out;
}

/// All fields on one line.
template <class M>
std::string print_line(const M& message) {
    std::string out;
    visit_fields(message, [&](const FieldView& field) {
        if (!out.empty()) out += ", ";
        out += field_text(field);
    });
    return out.empty() ? "no fields" : out;
}

}  // namespace echoloop::wire
