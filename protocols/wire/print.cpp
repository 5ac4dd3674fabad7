#include "protocols/wire/print.h"

namespace echoloop::wire {

std::string field_text(const FieldView& field) {
    std::string out = field.name + ' ' + value_text(field);
    if (field.unit.empty()) return out;
    const bool factor = field.unit[0] >= '0' && field.unit[0] <= '9';
    return out.append(factor ? " x " : " ").append(field.unit);
}

}  // namespace echoloop::wire
