#include "protocols/wire/print.h"

namespace echoloop::wire {

std::string field_text(const FieldView& field) {
    std::string out = field.name + ' ' + value_text(field);
    if (!field.unit.empty()) out.append(" ").append(field.unit);
    return out;
}

}  // namespace echoloop::wire
