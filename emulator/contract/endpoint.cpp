#include "emulator/contract/endpoint.h"

#include <array>
#include <optional>
#include <stdexcept>

#include "emulator/contract/network.h"

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

const SchemeForm& find_form(std::string_view uri) {
    const auto name = uri.substr(0, uri.find(':'));
    for (const auto& form : forms)
        if (uri.size() > name.size() && form.name == name) return form;
    std::string known;
    for (const auto& form : forms) known += (known.empty() ? "" : ", ") + std::string(form.example);
    fail(uri, "it does not begin with a known scheme; write one of " + known);
}

/// A setting behind the '?' of an endpoint.
struct Setting {
    std::string_view key;
    Scheme scheme;
    std::string_view help;
    bool (*fits)(std::string_view value);
};

constexpr std::array<Setting, 5> settings{{
    {"local_port", Scheme::udp, "local_port is a number from 1 to 65535",
     [](std::string_view v) { return decimal(v, 65535).value_or(0) > 0; }},
    {"baud_check", Scheme::pty, "baud_check is on (a rate that is not the device's makes garbage) or off",
     [](std::string_view v) { return v == "on" || v == "off"; }},
    {"usb_latency", Scheme::pty, "usb_latency is the timer of a USB adapter in ms, from 1 to 255, usually 16",
     [](std::string_view v) { return decimal(v, 255).value_or(0) > 0; }},
    {"idle", Scheme::tcp_listen,
     "idle is a number of s up to 65535, after which a driver that says and takes nothing makes way for "
     "another, or off",
     [](std::string_view v) { return v == "off" || decimal(v, 65535); }},
    {"group", Scheme::pty, "group is the group whose members may open the pseudo-terminal, e.g. dialout",
     [](std::string_view v) { return !v.empty(); }},
}};

const Setting& find_setting(std::string_view uri, Scheme scheme, std::string_view key) {
    std::string known;
    for (const Setting& setting : settings) {
        if (setting.scheme == scheme && setting.key == key) return setting;
        known += (known.empty() ? "" : ", ") + std::string(form_of(setting.scheme).name) + " has " +
                 std::string(setting.key);
    }
    fail(uri, "unknown setting " + quoted(key) + "; " + known);
}

void parse_query(Endpoint& endpoint, std::string_view uri, std::string_view query) {
    while (!query.empty()) {
        const auto pair = query.substr(0, query.find('&'));
        query.remove_prefix(std::min(query.size(), pair.size() + 1));
        const auto key = pair.substr(0, pair.find('='));
        const auto value = pair.substr(std::min(pair.size(), key.size() + 1));
        const Setting& setting = find_setting(uri, endpoint.scheme, key);
        if (!setting.fits(value)) fail(uri, std::string(setting.help));
        const auto count = decimal(value, 65535);
        endpoint.query[std::string(key)] = count ? std::to_string(*count) : std::string(value);
    }
}

/// Cuts `rest` at its '?' and reads what is behind it.
void take_query(Endpoint& endpoint, std::string_view uri, std::string_view& rest) {
    const auto question = rest.find('?');
    if (question == std::string_view::npos) return;
    parse_query(endpoint, uri, rest.substr(question + 1));
    rest = rest.substr(0, question);
}

void parse_path(Endpoint& endpoint, std::string_view uri, std::string_view rest) {
    if (rest.starts_with("//")) rest.remove_prefix(2);
    take_query(endpoint, uri, rest);
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
    endpoint.path = rest.substr(rest.find_first_not_of('/') - 1);  // several slashes in front are one
}

void parse_network(Endpoint& endpoint, std::string_view uri, std::string_view rest) {
    const auto example = std::string(form_of(endpoint.scheme).example);
    if (!rest.starts_with("//")) fail(uri, "write it as in " + example);
    rest.remove_prefix(2);
    take_query(endpoint, uri, rest);
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

/// 0 if it is not set.
std::uint32_t count_of(const Endpoint& e, std::string_view key) {
    const auto found = e.query.find(key);
    return found == e.query.end() ? 0 : decimal(found->second, 65535).value_or(0);
}

std::string query_text(const Endpoint& e) {
    std::string text;
    for (const auto& [key, value] : e.query) text += (text.empty() ? "?" : "&") + key + "=" + value;
    return text;
}

bool on_path(const Endpoint& e) { return e.scheme == Scheme::pty || e.scheme == Scheme::serial; }

}  // namespace

std::uint16_t Endpoint::local_port() const {
    return static_cast<std::uint16_t>(count_of(*this, "local_port"));
}

bool Endpoint::checks_baud() const {
    const auto found = query.find("baud_check");
    return found == query.end() || found->second != "off";
}

std::string Endpoint::group() const {
    const auto found = query.find("group");
    return found == query.end() ? "" : found->second;
}

std::uint32_t Endpoint::usb_latency() const { return count_of(*this, "usb_latency"); }

std::optional<double> Endpoint::idle() const {
    constexpr double usual = 10;  // own choice: no maker says what its sonar does
    const auto found = query.find("idle");
    if (found == query.end()) return usual;
    if (found->second == "off") return {};
    return count_of(*this, "idle");
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

std::vector<Endpoint> parse_endpoints(std::span<const std::string> uris) {
    std::vector<Endpoint> endpoints;
    for (const std::string& uri : uris) endpoints.push_back(parse_endpoint(uri));
    return endpoints;
}

std::string_view scheme_name(Scheme scheme) { return form_of(scheme).name; }

std::string to_string(const Endpoint& e) {
    std::string text(scheme_name(e.scheme));
    if (e.scheme == Scheme::pty) return text + ":" + e.path + query_text(e);
    if (e.scheme == Scheme::serial)
        return text + "://" + e.path + (e.baud != 0 ? ":" + std::to_string(e.baud) : "");
    return text + "://" + e.host + ":" + std::to_string(e.port) + query_text(e);
}

double line_rate(std::span<const Endpoint> endpoints, double baud) {
    constexpr double usual = 115200;
    double slowest = baud;
    for (const Endpoint& e : endpoints) {
        if (e.scheme != Scheme::serial) continue;
        const double own = e.baud > 0 ? e.baud : baud > 0 ? baud : usual;
        slowest = slowest > 0 ? std::min(slowest, own) : own;
    }
    return slowest;
}

bool clash(const Endpoint& a, const Endpoint& b) {
    if (on_path(a) || on_path(b)) return on_path(a) && on_path(b) && a.path == b.path;
    if (a.on_udp() != b.on_udp()) return false;
    if (a.listens() && b.listens())
        return a.port != 0 && a.port == b.port && (a.ip == b.ip || a.ip == 0 || b.ip == 0);
    if (!a.listens() && !b.listens()) return a.local_port() != 0 && a.local_port() == b.local_port();
    return false;
}

}  // namespace echoloop
