#include "emulator/endpoint.h"

#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>

namespace echoloop {
namespace {

using Scheme = Endpoint::Scheme;

struct SchemeForm {
    Scheme scheme;
    std::string_view name;
    std::string_view example;
};

constexpr std::array<SchemeForm, 6> forms{{
    {Scheme::pty, "pty", "pty:/tmp/echoloop/micron"},
    {Scheme::serial, "serial", "serial:///dev/ttyUSB0:115200"},
    {Scheme::tcp_listen, "tcp-listen", "tcp-listen://127.0.0.1:9090"},
    {Scheme::tcp, "tcp", "tcp://127.0.0.1:9090"},
    {Scheme::udp_listen, "udp-listen", "udp-listen://127.0.0.1:65500"},
    {Scheme::udp, "udp", "udp://127.0.0.1:65400?local_port=65502"},
}};

const SchemeForm& form_of(Scheme scheme) { return forms.at(static_cast<std::size_t>(scheme)); }

constexpr std::size_t longest_uri = 1024;

std::string quoted(std::string_view text) {
    std::string shown = "'";
    for (const char c : text.substr(0, 80)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown + (text.size() > 80 ? "...'" : "'");
}

[[noreturn]] void fail(std::string_view uri, const std::string& why) {
    throw std::invalid_argument("endpoint " + quoted(uri) + ": " + why);
}

std::optional<std::uint32_t> decimal(std::string_view text, std::uint32_t maximum) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size() || value > maximum)
        return {};
    return value;
}

std::optional<std::uint32_t> parse_ipv4(std::string_view text) {
    std::uint32_t ip = 0;
    for (int octet = 0; octet < 4; ++octet) {
        const auto dot = octet < 3 ? text.find('.') : text.size();
        if (dot == std::string_view::npos || dot > 3) return {};
        const auto value = decimal(text.substr(0, dot), 255);
        if (!value) return {};
        ip = ip << 8 | *value;
        text.remove_prefix(octet < 3 ? dot + 1 : dot);
    }
    return ip;
}

std::string ipv4_text(std::uint32_t ip) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
        text += std::to_string(ip >> shift & 0xFF) + (shift > 0 ? "." : "");
    return text;
}

const SchemeForm& find_form(std::string_view uri) {
    const auto name = uri.substr(0, uri.find(':'));
    for (const auto& form : forms)
        if (uri.size() > name.size() && form.name == name) return form;
    std::string known;
    for (const auto& form : forms) known += (known.empty() ? "" : ", ") + std::string(form.example);
    fail(uri, "it does not begin with a known scheme; write one of " + known);
}

void parse_path(Endpoint& endpoint, std::string_view uri, std::string_view rest) {
    if (rest.starts_with("//")) rest.remove_prefix(2);
    if (endpoint.scheme == Scheme::serial) {
        const auto colon = rest.rfind(':');
        if (colon != std::string_view::npos && colon > rest.rfind('/')) {
            const auto baud = decimal(rest.substr(colon + 1), 20'000'000);
            if (!baud || *baud == 0) fail(uri, "the line rate after ':' is a number of bit/s, e.g. 115200");
            endpoint.baud = *baud;
            rest = rest.substr(0, colon);
        }
    }
    const auto example = std::string(form_of(endpoint.scheme).example);
    if (!rest.starts_with('/')) fail(uri, "the path must be absolute, as in " + example);
    if (rest.ends_with('/')) fail(uri, "the path names a folder; add a name, as in " + example);
    endpoint.path = rest;
}

void parse_query(Endpoint& endpoint, std::string_view uri, std::string_view query) {
    while (!query.empty()) {
        const auto pair = query.substr(0, query.find('&'));
        query.remove_prefix(std::min(query.size(), pair.size() + 1));
        const auto key = pair.substr(0, pair.find('='));
        const auto value = pair.substr(std::min(pair.size(), key.size() + 1));
        if (key != "local_port" || endpoint.scheme != Scheme::udp)
            fail(uri, "unknown setting " + quoted(key) + "; only udp:// has one, local_port");
        const auto port = decimal(value, 65535);
        if (!port || *port == 0) fail(uri, "local_port is a number from 1 to 65535");
        endpoint.query[std::string(key)] = std::to_string(*port);
    }
}

void parse_network(Endpoint& endpoint, std::string_view uri, std::string_view rest) {
    const auto example = std::string(form_of(endpoint.scheme).example);
    if (!rest.starts_with("//")) fail(uri, "write it as in " + example);
    rest.remove_prefix(2);
    const auto question = rest.find('?');
    if (question != std::string_view::npos) parse_query(endpoint, uri, rest.substr(question + 1));
    rest = rest.substr(0, question);
    const auto colon = rest.rfind(':');
    if (colon == std::string_view::npos) fail(uri, "the port is missing; write it as in " + example);
    const auto host = rest.substr(0, colon);
    const auto ip = parse_ipv4(host == "localhost" ? "127.0.0.1" : host);
    if (!ip) fail(uri, quoted(host) + " is not an IPv4 address; host names are not looked up");
    const auto port = decimal(rest.substr(colon + 1), 65535);
    if (!port) fail(uri, "the port is a number up to 65535, as in " + example);
    if (!endpoint.listens() && (*port == 0 || *ip == 0))
        fail(uri, "0 is no destination; give the host's address and port");
    endpoint.ip = *ip;
    endpoint.host = ipv4_text(*ip);
    endpoint.port = static_cast<std::uint16_t>(*port);
}

bool on_path(const Endpoint& e) { return e.scheme == Scheme::pty || e.scheme == Scheme::serial; }
bool on_udp(const Endpoint& e) { return e.scheme == Scheme::udp || e.scheme == Scheme::udp_listen; }

}  // namespace

std::uint16_t Endpoint::local_port() const {
    const auto found = query.find("local_port");
    return found == query.end() ? 0 : static_cast<std::uint16_t>(decimal(found->second, 65535).value_or(0));
}

Endpoint parse_endpoint(std::string_view uri) {
    if (uri.size() > longest_uri) fail(uri, "it is longer than 1024 characters");
    for (const char c : uri)
        if (c < '!' || c > '~') fail(uri, "it holds a space, a control or a non-ASCII character");
    const auto& form = find_form(uri);
    Endpoint endpoint;
    endpoint.scheme = form.scheme;
    const auto rest = uri.substr(form.name.size() + 1);
    if (on_path(endpoint)) {
        parse_path(endpoint, uri, rest);
    } else {
        parse_network(endpoint, uri, rest);
    }
    return endpoint;
}

std::string_view scheme_name(Scheme scheme) { return form_of(scheme).name; }

std::string to_string(const Endpoint& e) {
    std::string text(scheme_name(e.scheme));
    if (e.scheme == Scheme::pty) return text + ":" + e.path;
    if (e.scheme == Scheme::serial)
        return text + "://" + e.path + (e.baud != 0 ? ":" + std::to_string(e.baud) : "");
    text += "://" + e.host + ":" + std::to_string(e.port);
    return e.local_port() != 0 ? text + "?local_port=" + std::to_string(e.local_port()) : text;
}

bool clash(const Endpoint& a, const Endpoint& b) {
    if (on_path(a) || on_path(b)) return on_path(a) && on_path(b) && a.path == b.path;
    if (on_udp(a) != on_udp(b)) return false;
    if (a.listens() && b.listens())
        return a.port != 0 && a.port == b.port && (a.ip == b.ip || a.ip == 0 || b.ip == 0);
    if (!a.listens() && !b.listens()) return a.local_port() != 0 && a.local_port() == b.local_port();
    return false;
}

}  // namespace echoloop
