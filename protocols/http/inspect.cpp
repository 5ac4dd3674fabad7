#include "protocols/http/inspect.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "protocols/http/request.h"
#include "protocols/waterlinked/json_text.h"

namespace echoloop::http {
namespace {

using inspect::Field;
using inspect::Message;

constexpr std::string_view status_sign = "HTTP/1.";

std::string_view text_of(wire::ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A number, or a value between quotes, as it stands in JSON or in a query.
Field field_of(std::string_view name, std::string_view value) {
    Field field{.name = std::string(name), .text = std::string(waterlinked::unquoted(value))};
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error == std::errc() && end == value.data() + value.size()) field.number = number;
    return field;
}

/// "a=1&b=2".
void add_query(std::string_view query, Message& out) {
    while (!query.empty()) {
        const std::string_view part = query.substr(0, query.find('&'));
        query.remove_prefix(std::min(part.size() + 1, query.size()));
        const std::size_t equals = std::min(part.find('='), part.size());
        out.fields.push_back(
            field_of(part.substr(0, equals), part.substr(std::min(equals + 1, part.size()))));
    }
}

void add_body(std::string_view body, Message& out) {
    if (body.empty()) return;
    const auto members = waterlinked::members_of(body);
    if (!members) return out.fields.push_back(field_of("body", body));
    for (const waterlinked::Member& member : *members)
        out.fields.push_back(field_of(member.key, member.value));
}

std::optional<Message> first_request(wire::ByteView bytes) {
    RequestReader reader;
    reader.feed(bytes);
    const auto next = reader.next();
    if (!next) return std::nullopt;
    Message out{.size = bytes.size()};
    if (const auto* refused = std::get_if<Refusal>(&*next)) {
        out.name = "request";
        out.reason = "HTTP request: it is answered by status " + std::to_string(refused->status);
        return out;
    }
    const auto& request = std::get<Request>(*next);
    const std::size_t query = std::min(request.target.find('?'), request.target.size());
    out.size -= reader.pending_bytes();
    out.name = request.method + " " + request.target.substr(0, query);
    add_query(std::string_view(request.target).substr(std::min(query + 1, request.target.size())), out);
    add_body(request.body, out);
    return out;
}

/// Bytes of the body that a head tells of; nothing where it tells none.
std::optional<std::size_t> told_length(std::string_view head) {
    std::string lower(head);
    std::ranges::transform(lower, lower.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    constexpr std::string_view name = "\r\ncontent-length:";
    const std::size_t found = lower.find(name);
    if (found == lower.npos) return std::nullopt;
    const std::size_t first = std::min(lower.find_first_not_of(' ', found + name.size()), lower.size());
    std::size_t length = 0;
    const auto [end, error] = std::from_chars(lower.data() + first, lower.data() + lower.size(), length);
    if (error != std::errc()) return std::nullopt;
    return length;
}

std::optional<Message> first_response(wire::ByteView bytes) {
    const std::string_view text = text_of(bytes);
    const std::size_t head = text.find("\r\n\r\n");
    if (std::min(head, text.size()) > longest_head)
        return Message{
            .size = bytes.size(), .name = "response", .reason = "HTTP response: its head has no end"};
    if (head == text.npos) return std::nullopt;
    const std::string_view line = text.substr(0, text.find("\r\n"));
    const std::size_t status = std::min(line.find(' ') + 1, line.size());
    const std::size_t body = head + 4, length = told_length(text.substr(0, head)).value_or(0);
    if (length > longest_body)
        return Message{
            .size = bytes.size(), .name = "response", .reason = "HTTP response: its body is too long"};
    if (text.size() - body < length) return std::nullopt;
    Message out{.size = body + length, .name = std::string(line.substr(status))};
    add_body(text.substr(body, length), out);
    return out;
}

}  // namespace

bool begins(wire::ByteView bytes) {
    constexpr std::array<std::string_view, 7> methods{"GET",   "HEAD",   "PUT",    "POST",
                                                      "PATCH", "DELETE", "OPTIONS"};
    const std::string_view text = text_of(bytes);
    if (text.starts_with(status_sign)) return true;
    return std::ranges::any_of(
        methods, [&](std::string_view method) { return text.starts_with(std::string(method) + " /"); });
}

std::optional<Message> first_message(wire::ByteView bytes) {
    return text_of(bytes).starts_with(status_sign) ? first_response(bytes) : first_request(bytes);
}

}  // namespace echoloop::http
