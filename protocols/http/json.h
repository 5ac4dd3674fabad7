// The JSON that small devices exchange: a bare value, or one flat object of them. No arrays, no nesting;
// never throws for text from outside.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace echoloop::http {

/// null, true or false, a finite number, a string.
using JsonScalar = std::variant<std::monostate, bool, double, std::string>;
using JsonObject = std::map<std::string, JsonScalar, std::less<>>;
using Json = std::variant<JsonScalar, JsonObject>;

/// Nothing if it is not JSON, or more than this file's kind of it.
std::optional<Json> read_json(std::string_view text);

/// The shortest digits that read back as the same number, with a decimal point or an exponent: 21.0.
std::string json_number(double value);
/// In quotes, with escapes.
std::string json_string(std::string_view text);

}  // namespace echoloop::http
