// The explicit table of sonar models and the description of their options. Rows only: no device code.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "emulator/contract/device.h"
#include "emulator/contract/endpoint.h"
#include "emulator/contract/known_driver.h"
#include "emulator/contract/network.h"
#include "emulator/contract/profile.h"
#include "render/effects.h"
#include "render/geographic.h"

namespace echoloop {

/// A value of an option in a scenario: a YAML scalar, already converted to the option's type.
using OptionValue = std::variant<bool, std::int64_t, double, std::string>;

/// One option of a model, as `echoloop list --json` shows it and as the scenario loader checks it.
struct Option {
    std::string name;
    std::string unit;           ///< "" if none
    OptionValue default_value;  ///< its alternative is the option's type
    std::string help;
    std::string source;                ///< where the default comes from
    std::vector<std::string> choices;  ///< text options: the legal words; empty: any text
    double minimum = -1e300;           ///< numbers: inclusive bounds
    double maximum = 1e300;
};

using Options = std::map<std::string, OptionValue, std::less<>>;  ///< complete: every option has a value

/// What a device is made from.
struct DeviceConfig {
    std::string name;
    std::vector<Endpoint> endpoints;
    Options options;
    Profile profile;
    Effects effects;               ///< of the scenario; a device does its own time-varied gain
    double sound_speed = 1500;     ///< m/s, the true one
    std::vector<Network> peers{};  ///< that may be sent to; none: the interfaces' own networks
    double unix_start = 0;  ///< s, Unix time at the start of the run, for devices that send wall-clock time
    std::optional<GeoPlace> origin{};  ///< of the world on the Earth, if that is known
    std::uint64_t random_key = 0;      ///< of seed and device, for its sensors
};

struct Model {
    std::string name;      ///< "tritech-micron"
    std::string title;     ///< "Tritech Micron DST scanning sonar"
    std::string protocol;  ///< "SeaNet, serial 115200 8N1"
    std::vector<std::string> default_endpoints;
    std::vector<std::string>
        endpoint_schemes;  ///< accepted for the first endpoint: "pty", "serial", "tcp-listen", ...
    std::vector<Option> options;
    std::vector<FigureRow> figures{};  ///< of its profile
    std::string_view profile{};        ///< the text of its own profile, which outlives the table
    /// Throws std::invalid_argument with a sentence for the user if an endpoint or option does not fit.
    std::unique_ptr<Device> (*make)(const DeviceConfig&) = nullptr;
    /// The ping that the device sends by itself or after a plain start: `step` counts the pings of a turn,
    /// `range` is in m, 0 for the default. nullptr: it is no sonar and sends no pings.
    Shot (*default_shot)(const DeviceConfig&, std::size_t step, double range) = nullptr;
    std::size_t turn_steps = 1;  ///< pings of a full turn; 1: one fan
    std::string_view family{};   ///< of its messages, as protocols/inspect.h calls it
    bool has_checksums = false;  ///< in its messages; models() fills it in
    /// What a plain driver says to get `pings` pings, at least one. Each message makes one, but for settings
    /// that come first; an empty one stands for a ping that comes by itself. `turns`: each ping is a step of
    /// the motor away from the one before. nullptr: the device pings unasked, or wants a longer talk.
    std::vector<Bytes> (*requests)(const DeviceConfig&, std::size_t pings, bool turns) = nullptr;
    std::vector<Destination> sends{};
    std::vector<KnownDriver> drivers{};  ///< the first that fits counts
};

/// All models, sorted by name.
std::span<const Model> models();
/// nullptr if there is none of that name.
const Model* find_model(std::string_view name);

}  // namespace echoloop
