#include <bit>
#include <numeric>

#include "tools/echoloop/bench/wire.h"

namespace echoloop::bench {
namespace {

using Word = WireCase::Word;

Bytes text(std::string_view words) { return {words.begin(), words.end()}; }

Bytes hex(std::string_view digits) {
    Bytes bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16)));
    return bytes;
}

template <class T>
void put(Bytes& bytes, T value) {
    const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof value>>(value);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

/// Fire, version 1: low frequency, 10 Hz, 20 m, 50 %. `flags`: 1 metres, 2 16 bits, 4 gain words, 8 simple,
/// 0x40 512 beams.
Bytes fire(std::uint8_t gamma, std::uint8_t flags) {
    Bytes bytes = hex("534f0000000015000000250000000000");
    for (const std::uint8_t byte : {std::uint8_t{1}, std::uint8_t{0}, std::uint8_t{255}, gamma, flags})
        bytes.push_back(byte);
    for (const double number : {20.0, 50.0, 1500.0, 35.0}) put(bytes, number);
    return bytes;
}

/// 7500 with 1051: a subscription to one type of record.
Bytes subscription(std::uint32_t type) {
    Bytes b(36 + 64 + 24);
    const auto at = [&b](std::size_t offset, std::uint32_t value, std::size_t size = 4) {
        for (std::size_t i = 0; i < size; ++i) b.at(offset + i) = static_cast<std::uint8_t>(value >> (8 * i));
    };
    at(36, 5, 2), at(38, 60, 2), at(40, 0xFFFF), at(66, 1, 2), at(68, 7500), at(72, 7125), at(84, 1, 2),
        at(100, 1051);
    put(b, std::uint32_t{1}), put(b, type);
    const auto size = static_cast<std::uint32_t>(b.size() + 4 - 36);
    at(44, size);
    put(b, std::accumulate(b.begin() + 36, b.end(), 0U));
    at(0, 5, 2), at(2, 36, 2), at(4, 1), at(8, 1, 2), at(10, 9, 2), at(12, size + 36), at(16, size);
    return b;
}

WireCase r2sonic(std::string name, Options options) {
    options.insert({{"range", 22.65}});  // 2000 bins of 256 beams
    return {"r2sonic " + std::move(name), "r2sonic-2024", std::move(options), {}};
}
WireCase oculus(std::string name, std::uint8_t gamma, std::uint8_t flags) {
    return {"oculus " + std::move(name), "oculus-m1200d", {}, {{0, fire(gamma, flags)}}};
}
WireCase reson(std::string name, std::uint32_t type) {
    return {"reson " + std::move(name),
            "reson-7k",
            {{"beams", std::int64_t{512}}, {"range", 21.74}},
            {{0, subscription(type)}}};
}
WireCase norbit(std::string name, Options options, const std::string& end = "10.05") {
    options.insert({{"power", true}, {"beam_mode", std::string("512EA")}});
    return {"norbit " + std::move(name),
            "norbit-wbms",
            std::move(options),
            {{0, text("set_tp_rate -1\r\nset_gate_mode 0\r\nset_range 0.5 " + end +
                      "\r\nset_resolution 1000 512\r\n")}}};
}
WireCase kmall(std::string name, Options options, double range = 6.56) {
    options.insert({{"soundings", std::int64_t{512}}, {"range", range}});
    return {"kmall " + std::move(name), "kongsberg-kmall", std::move(options), {}};
}

/// The example of the specification notes in one of the model's ping modes.
WireCase aris(const std::string& number, std::uint8_t mode) {
    Bytes settings =
        hex("0000002508032a2108071500007041"
            "18f60720ec0f2884523008380b40034801500158016500009041");
    constexpr std::size_t mode_at = 29;
    settings.at(mode_at) = mode;
    return {"aris " + number, "aris-" + number, {}, {{0, hex("0000000808011a0408fcb803")}, {0, settings}}};
}

}  // namespace

std::vector<WireCase> wire_cases() {
    const std::string whole_echo = "magnitude";
    const Options looking_forward{{"system", std::string("forward-looking")}};  // no bottom is looked for
    const auto with_samples = [&](const char* sample) {
        Options options = looking_forward;
        options.insert({{"sample", std::string(sample)}});
        return options;
    };
    return {r2sonic("bathymetry", {}),
            r2sonic("image, a bin each", {{"image_height", std::int64_t{2000}}}),
            r2sonic("image, 4 bins each", {{"image_height", std::int64_t{500}}}),
            r2sonic("water column", {{"water_column", whole_echo}}),
            r2sonic("water column, phase", {{"water_column", std::string("phase")}}),
            r2sonic("snippets", {{"snippets", true}}),
            r2sonic("truepix", {{"truepix", std::string("direction")}}),
            oculus("8 bits", 255, 0x49),
            oculus("8 bits, gamma 127", 127, 0x49),
            oculus("8 bits, gamma 90", 90, 0x49),
            oculus("8 bits, gain words", 127, 0x4D),
            oculus("16 bits", 255, 0x4B),
            reson("bathymetry 7027", 7027),
            reson("magnitude and phase 7018", 7018),
            reson("image 7011", 7011),
            norbit("512, s16", {}),
            norbit("512, u8", {{"sample", std::string("u8")}}),
            norbit("512, f32", {{"sample", std::string("f32")}}),
            norbit("512, s16, 2 bins a row", {}, "19.5"),
            norbit("image alone, s16", looking_forward),
            norbit("image alone, u8", with_samples("u8")),
            norbit("image alone, f32", with_samples("f32")),
            kmall("bathymetry", {}),
            kmall("water column", {{"water_column", true}}),
            kmall("water column, 1000 samples", {{"water_column", true}}, 26.2),
            aris("1200", 1),
            aris("1800", 3),
            aris("3000", 6),
            {"omniscan",
             "omniscan450",
             {},
             {{0, hex("425224009508000000000000983a00000000000000000000"
                      "000000006f12033ba69bc43affff5802010000007e07")}}},
            {"s500", "s500", {}, {{0, hex("42521400f7030000000000004c1d0000ffff640000001c05000000008e04")}}},
            {"surveyor",
             "surveyor240",
             {},
             {{0, hex("42522400cf0b000000000000102700000080bb44ffff6400"
                      "000000010000000180a90300900100000000c03f6808")}}},
            {"delta t", "imagenex-deltat", {}, {}},
            {"sonar 3d", "sonar-3d-15", {{"acoustics", true}}, {}},
            {"dvl", "dvl-a50", {}, {}},
            {"nortek dvl", "nortek-dvl1000", {{"login", std::string("none")}}, {}},
            {"nucleus", "nortek-nucleus", {{"starts_at_once", true}, {"login", false}}, {}},
            {"wayfinder", "dvl-wayfinder", {}, {}}};
}

}  // namespace echoloop::bench
