#include "emulator/devices/kongsberg-kmall/texts.h"

#include <cmath>
#include <cstdio>

#include "emulator/devices/kongsberg-kmall/controls.h"

namespace echoloop::kongsberg_kmall {
namespace {

// As a published example has them.
constexpr unsigned command_port = 2012;
constexpr unsigned serial_inputs = 4, udp_inputs = 6, network_inputs = 1;

std::string ip_text(std::uint32_t ip) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
        text += std::to_string(ip >> shift & 0xFF) + (shift > 0 ? "." : "");
    return text;
}

std::string description(const Settings& settings) {
    return "SOUNDER: EM " + std::to_string(settings.sounder) + ", System:Single Swath, END!";
}

void put(std::string& bytes, std::uint64_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 0xFF);
}

/// "name=value;colour": G is good, B is off.
std::string off(const char* name) { return std::string(",") + name + "=OFF;B"; }
std::string good(const char* name, const std::string& value = "OK") {
    return std::string(",") + name + '=' + value + ";G";
}

}  // namespace

std::string sounder_name(const Settings& settings) {
    return "EM" + std::to_string(settings.sounder) + '_' + std::to_string(settings.system_id);
}

kmall::Command found(const Settings& settings, const Standing& standing) {
    const auto pair = [](const char* name, const std::string& value) {
        return std::string(name) + '=' + value + "~~";
    };
    const auto number = [&](const char* name, unsigned value) { return pair(name, std::to_string(value)); };
    return {12, "",
            pair("IP", ip_text(standing.own.ip)) + number("CMDPORT_PORT", command_port) +
                pair("NAME", sounder_name(settings)) + number("TYPE", settings.sounder) +
                number("STARTED", standing.started) + number("IS_PINGING", settings.pinging) +
                number("SYSTEM_ID", settings.system_id) + pair("DATA_MACST_IP", ip_text(standing.data.ip)) +
                number("DATA_MACST_PORT", standing.data.port) + number("NO_RX_ETH", network_inputs) +
                number("NO_RX_MCAST", 0) + number("NO_RX_SERIAL", serial_inputs) +
                number("NO_RX_UDP", udp_inputs) + pair("SYSTEM_DESC", description(settings)) + "$$$"};
}

kmall::Command data_address(const Settings& settings, const Standing& standing) {
    return {455, sounder_name(settings),
            ',' + ip_text(standing.data.ip) + ',' + std::to_string(standing.data.port)};
}

kmall::Command unit_found(const Settings& settings, const Standing& standing, double unix_time) {
    const std::string text = description(settings);
    const std::size_t padded = (text.size() / 4 + 1) * 4;  // with a zero at its end
    const std::size_t size = 20 + 20 + padded + 4;
    std::string bytes;
    put(bytes, size, 4);
    bytes += "#IPI";
    put(bytes, 0, 1);  // version
    put(bytes, settings.system_id, 1);
    put(bytes, settings.sounder, 2);
    put(bytes, static_cast<std::uint32_t>(unix_time), 4);
    put(bytes, static_cast<std::uint32_t>((unix_time - std::floor(unix_time)) * 1e9), 4);
    put(bytes, 0, 2);  // not understood
    put(bytes, standing.started, 2);
    put(bytes, command_port, 2);
    put(bytes, standing.data.port, 2);
    for (int shift = 24; shift >= 0; shift -= 8) put(bytes, standing.data.ip >> shift, 1);
    put(bytes, serial_inputs, 2);
    put(bytes, udp_inputs, 1);
    put(bytes, network_inputs, 1);
    put(bytes, 0, 4);  // not understood
    bytes += text;
    bytes.resize(size - 4);
    put(bytes, size, 4);
    return {812, sounder_name(settings), ',' + bytes};
}

kmall::Command status(const Settings& settings, const Standing& standing) {
    char depth[32] = "--";
    if (standing.depth) std::snprintf(depth, sizeof depth, "%.2f", *standing.depth);
    std::string text = settings.pinging ? good("EM status", "ON") : off("EM status");
    text += good("CPU Temperature") + good("Position system 1") + off("Position system 2") +
            off("Position system 3") + good("Attitude system 1") + off("Attitude system 2") +
            off("Depth sensor") + good("Sound velocity probe") + good("Time sync.") + off("1PPS");
    text += standing.depth ? good("Depth", depth) : std::string(",Depth=--;B");
    return {616, sounder_name(settings), text};
}

kmall::Command values(const Settings& settings) {
    const bool xml = settings.values_as_xml;
    return {xml ? 814U : 401U, sounder_name(settings),
            ',' + (xml ? values_as_xml(settings) : values_as_json(settings))};
}

}  // namespace echoloop::kongsberg_kmall
