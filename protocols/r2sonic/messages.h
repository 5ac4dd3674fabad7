// The datagrams of R2Sonic multibeam sonars as plain structs. No wire code: layouts.h says how they stand on
// the wire. IPv4 addresses are u32 in host order, the first octet in the top byte.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "protocols/r2sonic/sections.h"
#include "protocols/r2sonic/status.h"
#include "protocols/r2sonic/water_sections.h"

namespace echoloop::r2sonic {

inline constexpr std::uint16_t discovery_port = 53810;  ///< 0x8000 + ASCII "R2"

/// Bathymetry, one datagram per ping. H0.points is written as the size of R0.
struct Bth0 {
    std::uint32_t stream_id = 0;
    H0 h0;
    R0 r0;
    std::variant<A0, A2> angles;  ///< equi-angle or equi-distant
    std::optional<I1> i1;
    G0 g0;
    std::optional<G1> g1;
    Q0 q0;

    friend bool operator==(const Bth0&, const Bth0&) = default;
};

/// First datagram of an acoustic image. H0.points is written as the number of angles.
struct Aid0Head {
    std::uint32_t stream_id = 0;
    H0 h0;
    A1 a1;

    friend bool operator==(const Aid0Head&, const Aid0Head&) = default;
};
/// Every other datagram of an acoustic image.
struct Aid0Data {
    std::uint32_t stream_id = 0;
    M0 m0;

    friend bool operator==(const Aid0Data&, const Aid0Data&) = default;
};

/// First datagram of a water column. H0.points is written as the number of angles.
struct Wcd0Head {
    std::uint32_t stream_id = 0;
    H0 h0;
    A1 a1;

    friend bool operator==(const Wcd0Head&, const Wcd0Head&) = default;
};
/// Every other datagram of a water column.
struct Wcd0Data {
    std::uint32_t stream_id = 0;
    std::variant<M1, M2> samples;

    friend bool operator==(const Wcd0Data&, const Wcd0Data&) = default;
};

/// Snippets: one or more in a datagram, the settings in the first datagram of a ping.
struct Sni0 {
    std::uint32_t stream_id = 0;
    std::optional<LongH0> h0;
    S1 s1;
    std::vector<S1> others;  ///< that follow s1

    friend bool operator==(const Sni0&, const Sni0&) = default;
};

/// Part of a TruePix ping, the settings in its first datagram.
struct Tpx0 {
    std::uint32_t stream_id = 0;
    std::optional<LongH0> h0;
    std::variant<D0, D1> samples;

    friend bool operator==(const Tpx0&, const Tpx0&) = default;
};

/// Status of the head.
struct Sth0 {
    std::uint32_t stream_id = 0;
    std::vector<StatusSection> sections;

    friend bool operator==(const Sth0&, const Sth0&) = default;
};
/// Status of the SIM.
struct Sts0 {
    std::uint32_t stream_id = 0;
    std::vector<StatusSection> sections;

    friend bool operator==(const Sts0&, const Sts0&) = default;
};

/// Short status, every 1.3 s from head and SIM.
struct R2ds {
    wire::Text<12> serial;
    std::uint32_t config_id = 0;  ///< from the latest R2DC
    std::uint32_t reserved = 0;

    friend bool operator==(const R2ds&, const R2ds&) = default;
};

/// Discovery request of the host, broadcast.
struct R2dd {
    std::uint32_t gui_ip = 0;
    std::uint16_t gui_port = 0;  ///< GUI base port
    std::uint16_t reserved10 = 0;
    std::array<std::uint32_t, 8> reserved12{};

    friend bool operator==(const R2dd&, const R2dd&) = default;
};

/// Answer of one device to R2DD.
struct R2di {
    wire::Text<12> serial;
    wire::Text<12> part;
    wire::Text<12> model;
    std::array<std::uint32_t, 8> reserved{};

    friend bool operator==(const R2di&, const R2di&) = default;
};

/// Configuration of the device with that serial number, broadcast.
struct R2dc {
    wire::Text<12> serial;
    std::uint32_t config_id = 0;
    std::uint32_t mask = 0;
    std::uint32_t gateway = 0;
    std::uint32_t gui_ip = 0;
    std::uint16_t gui_port = 0;
    std::uint16_t system_index = 0;
    std::array<std::uint32_t, 4> head_ip{};
    std::array<std::uint16_t, 4> head_port{};
    std::array<std::uint32_t, 4> sim_ip{};
    std::array<std::uint16_t, 4> sim_port{};
    std::array<std::uint32_t, 8> daq_ip{};
    std::array<std::uint16_t, 8> daq_port{};
    std::array<std::uint32_t, 8> reserved{};

    friend bool operator==(const R2dc&, const R2dc&) = default;
};

/// One setting, e.g. "RNG0"; the name decides whether the value is a u32 or an f32.
struct Command {
    wire::Text<4> name;
    std::uint32_t raw = 0;

    std::uint32_t as_u32() const { return raw; }
    float as_f32() const { return std::bit_cast<float>(raw); }
    static Command u32(std::string_view name, std::uint32_t value) { return {name, value}; }
    static Command f32(std::string_view name, float value) {
        return {name, std::bit_cast<std::uint32_t>(value)};
    }

    friend bool operator==(const Command&, const Command&) = default;
};

/// Any number of settings in one datagram.
struct Cmd0 {
    std::vector<Command> commands;

    friend bool operator==(const Cmd0&, const Cmd0&) = default;
};

using Packet = std::variant<Bth0, Aid0Head, Aid0Data, Wcd0Head, Wcd0Data, Sni0, Tpx0, Sth0, Sts0, R2ds, R2dd,
                            R2di, R2dc, Cmd0>;

}  // namespace echoloop::r2sonic
