#include "protocols/wire/result.h"

namespace echoloop::wire {

std::string_view text(Reason reason) {
    switch (reason) {
        case Reason::truncated:
            return "the bytes end here";
        case Reason::trailing_bytes:
            return "bytes left over behind the last field";
        case Reason::wrong_constant:
            return "not the value that always stands here";
        case Reason::wrong_count:
            return "a count that does not fit the others";
        case Reason::wrong_size:
            return "a size that the message cannot have";
        case Reason::wrong_section:
            return "not the section that stands here";
        case Reason::unknown_message:
            return "no layout for this message";
    }
    return "unknown reason";
}

std::string Error::what() const {
    std::string out(message);
    if (!field.empty()) out.append(".").append(field);
    return out.append(" at byte ").append(std::to_string(offset)).append(": ").append(text(reason));
}

}  // namespace echoloop::wire
