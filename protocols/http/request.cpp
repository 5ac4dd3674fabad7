#include "protocols/http/request.h"

#include <algorithm>
#include <charconv>

namespace echoloop::http {
namespace {

constexpr std::string_view blank_line = "\r\n\r\n";

std::string_view reason(int status) {
    switch (status) {
        case 200:
            return "OK";
        case 204:
            return "No Content";
        case 400:
            return "Bad Request";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 408:
            return "Request Timeout";
        case 413:
            return "Content Too Large";
        case 431:
            return "Request Header Fields Too Large";
        case 501:
            return "Not Implemented";
        default:
            return "Error";
    }
}

bool equal_names(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return lower(x) == lower(y); });
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

/// The next line of `text`, which loses it.
std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find("\r\n"), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 2, text.size()));
    return line;
}

bool read_request_line(std::string_view line, Request& request) {
    const std::size_t first = line.find(' '), last = line.rfind(' ');
    if (first == 0 || first == std::string_view::npos || last <= first + 1) return false;
    request.method = line.substr(0, first);
    request.target = line.substr(first + 1, last - first - 1);
    const bool words = std::all_of(request.target.begin(), request.target.end(),
                                   [](char c) { return c > ' ' && c < 127; }) &&
                       std::all_of(request.method.begin(), request.method.end(),
                                   [](char c) { return c >= 'A' && c <= 'Z'; });
    return words && line.substr(last + 1).starts_with("HTTP/1.");
}

/// How the body comes.
struct BodyForm {
    std::optional<std::size_t> length;  ///< B; none: 0
    bool chunked = false;
};

/// Or the status of a refusal.
std::variant<BodyForm, int> read_headers(std::string_view headers, Request& request) {
    BodyForm form;
    while (!headers.empty()) {
        const std::string_view line = take_line(headers);
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos || colon == 0) return 400;
        const std::string_view name = line.substr(0, colon), value = trimmed(line.substr(colon + 1));
        if (equal_names(name, "Host")) request.host = value;
        if (equal_names(name, "Origin")) request.origin = value;
        if (equal_names(name, "Transfer-Encoding")) {
            if (!equal_names(value, "chunked") || form.chunked) return 501;
            form.chunked = true;
        }
        if (!equal_names(name, "Content-Length")) continue;
        std::size_t length = 0;
        const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), length);
        if (error != std::errc() || end != value.data() + value.size()) return 400;
        if (length > longest_body) return 413;
        if (form.length && form.length != length) return 400;
        form.length = length;
    }
    if (form.chunked && form.length) return 400;  // two lengths, and nobody knows which
    return form;
}

}  // namespace

bool is_of_foreign_page(const Request& request) {
    std::string_view name = request.host;
    if (const std::size_t colon = name.rfind(':'); colon != name.npos && !name.ends_with(']'))
        name = name.substr(0, colon);
    const bool address = name.starts_with('[') || name.find_first_not_of("0123456789.") == name.npos;
    if (!address && !equal_names(name, "localhost")) return true;
    return !request.origin.empty() && !equal_names(request.origin, "http://" + request.host);
}

void RequestReader::feed(wire::ByteView bytes) { buffer_.append(bytes.begin(), bytes.end()); }

void RequestReader::clear() {
    buffer_.clear();
    chunked_.reset();
}

std::size_t RequestReader::pending_bytes() const {
    return buffer_.size() + (chunked_ ? chunked_->request.target.size() + chunked_->request.body.size() : 0);
}

Refusal RequestReader::refuse(int status) {
    clear();
    return Refusal{status};
}

RequestReader::Next RequestReader::next() {
    if (chunked_) return next_of_chunks();
    buffer_.erase(0, std::min(buffer_.find_first_not_of("\r\n"), buffer_.size()));  // between two requests
    if (buffer_.empty()) return std::nullopt;
    const std::size_t end = buffer_.find(blank_line);
    if (std::min(end, buffer_.size()) > longest_head) return refuse(431);
    if (end == std::string::npos) return std::nullopt;
    Request request;
    std::string_view head = std::string_view(buffer_).substr(0, end);
    if (!read_request_line(take_line(head), request)) return refuse(400);
    const auto form = read_headers(head, request);
    if (const int* status = std::get_if<int>(&form)) return refuse(*status);
    const std::size_t body = end + blank_line.size(), size = std::get<BodyForm>(form).length.value_or(0);
    if (std::get<BodyForm>(form).chunked) {
        chunked_ = Chunked{std::move(request), ChunkReader(longest_body)};
        buffer_.erase(0, body);
        return next_of_chunks();
    }
    if (buffer_.size() - body < size) return std::nullopt;
    request.body = buffer_.substr(body, size);
    buffer_.erase(0, body + size);
    return request;
}

RequestReader::Next RequestReader::next_of_chunks() {
    switch (chunked_->chunks.take(buffer_, chunked_->request.body)) {
        case ChunkReader::Progress::unfinished:
            return std::nullopt;
        case ChunkReader::Progress::malformed:
            return refuse(400);
        case ChunkReader::Progress::too_long:
            return refuse(413);
        case ChunkReader::Progress::whole:
            break;
    }
    Request request = std::move(chunked_->request);
    chunked_.reset();
    return request;
}

wire::Bytes response(int status, std::string_view body) {
    std::string text = "HTTP/1.1 " + std::to_string(status) + ' ' + std::string(reason(status)) + "\r\n";
    if (!body.empty()) text += "Content-Type: application/json\r\n";
    if (status != 204) text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
    text += "Connection: close\r\n\r\n";
    text += body;
    return {text.begin(), text.end()};
}

}  // namespace echoloop::http
