// A small table of models for the tests of the loader: two that resemble real ones, and one that refuses.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/contract/model.h"

namespace echoloop::test {

inline std::vector<Option> scanner_options() {
    return {{"gain", "%", 50.0, "receiver gain", "", {}, 0, 100},
            {"bins", "", std::int64_t{400}, "range bins", "", {}, 1, 1500},
            {"inverted", "", false, "head mounted upside down", "", {}},
            {"profile", "", std::string("dst"), "which head", "", {"dst", "miniking"}},
            {"serial_number", "", std::string("100"), "any text", "", {}}};
}

inline std::vector<FigureRow> scanner_figures() {
    return {{"source_level", "dB re 1 uPa", "on the axis", 100, 240},
            {"aperture", "", "shape", 0, 0, false, {"line", "piston"}},
            {"bits", "", "of the converter", 0, 32, true}};
}

inline constexpr std::string_view scanner_profile = R"(model: tritech-micron
source_level: {value: 206, unit: dB re 1 uPa, source: own estimate}
aperture: {value: line, source: own choice}
bits: {value: 24, source: own choice}
)";

inline const std::vector<Model>& test_models() {
    static const std::vector<Model> table = [] {
        Model fan{"r2sonic-2024", "a fan", "UDP", {"udp-listen://127.0.0.1:65500", "udp://127.0.0.1:65400"},
                  {"udp-listen"}, {}};
        Model picky{"picky", "a device that refuses", "none", {"pty:/tmp/echoloop/picky"}, {}, {}};
        picky.make = [](const DeviceConfig&) -> std::unique_ptr<Device> {
            throw std::invalid_argument("its endpoints do not fit each other");
        };
        Model scanner{"tritech-micron",
                      "a scanner",
                      "SeaNet",
                      {"pty:/tmp/echoloop/micron"},
                      {"pty", "serial", "tcp-listen"},
                      scanner_options(),
                      scanner_figures(),
                      scanner_profile};
        return std::vector<Model>{picky, fan, scanner};
    }();
    return table;
}

}  // namespace echoloop::test
