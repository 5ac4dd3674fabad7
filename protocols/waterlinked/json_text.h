// JSON as text: where a value ends and what stands at the top of an object. Enough to cut a stream and to
// show a message; whoever needs the values themselves parses them. Bounded by its input; allocates no tree.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace echoloop::waterlinked {

/// A member of an object as it stands there.
struct Member {
    std::string_view key;    ///< without quotes, escapes left as they are
    std::string_view value;  ///< "1.5", "\"text\"", "[1,2]"
};

/// Bytes of the object or array that `text` begins with: up to the bracket that closes its first one; 0: it
/// is not whole.
std::size_t json_size(std::string_view text);

/// The members of the object that `text` is, all of it; nothing if it is none. Inner values are not looked
/// at closely.
std::optional<std::vector<Member>> members_of(std::string_view text);

/// The value of the first member of that key; "" if there is none.
std::string_view value_of(const std::vector<Member>& members, std::string_view key);

/// What a string holds between its quotes; a value that is none as it is.
std::string_view unquoted(std::string_view value);

}  // namespace echoloop::waterlinked
