#include "emulator/devices/waterlinked-dvl/host_text.h"

#include <algorithm>
#include <utility>

#include "protocols/waterlinked/json_text.h"

namespace echoloop::waterlinked_dvl {
namespace {

constexpr std::size_t longest_document = 65536, longest_command = 128;  // B
constexpr std::string_view white = " \t\r\n";

std::string cut(std::string& text, std::size_t size) {
    std::string front = text.substr(0, size);
    text.erase(0, size);
    return front;
}

}  // namespace

void HostText::feed(ByteView bytes, Time now) {
    if (text_.empty()) since_ = now;
    text_.append(bytes.begin(), bytes.end());
}

std::optional<std::string> HostText::next_document() {
    text_.erase(0, std::min(text_.find_first_not_of(white), text_.size()));
    if (text_.empty()) return std::nullopt;
    if (text_[0] != '{' && text_[0] != '[')
        return cut(text_, std::min(text_.find_first_of("{["), text_.size()));
    const std::size_t size = waterlinked::json_size(text_);
    if (size > 0) return cut(text_, size);
    if (text_.size() > longest_document) return take_all();
    return std::nullopt;
}

std::optional<std::string> HostText::next_line() {
    text_.erase(0, std::min(text_.find_first_not_of("\r\n"), text_.size()));
    const std::size_t end = std::min(text_.find_first_of("\r\n"), text_.size());
    if (end == text_.size() && end < longest_command) return std::nullopt;
    return cut(text_, end);
}

std::string HostText::take_all() { return std::exchange(text_, {}); }

}  // namespace echoloop::waterlinked_dvl
