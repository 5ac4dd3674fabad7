// The --json documents of the verbs. One of the two users of nlohmann-json's heavy header.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/scenario/scenario.h"
#include "protocols/inspect.h"
#include "render/echogram.h"
#include "render/scene/scene.h"
#include "tools/echoloop/bench/report.h"
#include "tools/echoloop/doctor/findings.h"
#include "tools/echoloop/driver.h"
#include "tools/echoloop/validate/findings.h"

namespace echoloop::cli {

/// {"ok": false, "problems": [{"where", "line", "column", "message"}]}
std::string problems_json(const std::vector<Problem>& problems);
std::string check_json(const Scenario& scenario, const Scene& scene);
std::string list_json(std::span<const Model> models);

struct DeviceEndpoints {
    const ScenarioDevice* device;
    std::vector<WirePlace> places;
    DriverHint hint;  ///< empty without a format
};
std::string endpoints_json(const std::string& format, const std::vector<DeviceEndpoints>& devices);

struct RenderReport {
    std::string out, device, model, renderer;
    std::vector<Echogram> pings;  ///< empty for --channels
};
std::string render_json(const RenderReport& report);

/// {"ok": true, "findings": [{"state", "name", "text", "remedy"}]}
std::string doctor_json(const Findings& findings);
std::string bench_json(const bench::Report& report);
std::string validate_json(const validation::Findings& findings);

/// Where a message of `echoloop inspect` comes from; addresses and time (s since the first datagram) only for
/// captures.
struct InspectOrigin {
    std::string family{};
    double time = 0;
    std::optional<Address> from{}, to{};
    std::string line{};        ///< serial: which, and who speaks
    std::uint64_t packet = 0;  ///< number of the packet that completed it, from 1; 0: there are none
};
/// What a capture says beside the bytes, e.g. which fault the packet has suffered.
struct PacketComment {
    std::uint64_t packet = 0;  ///< from 1
    double time = 0;           ///< s since the first packet
    std::string text{};
};
struct InspectSummary {
    std::map<std::string, std::size_t> messages;  ///< decoded ones by name
    std::size_t broken = 0;                       ///< messages that could be named but not decoded
    std::size_t undecoded_bytes = 0;
    std::optional<std::uint64_t> packets;  ///< captures only
    std::uint64_t skipped_packets = 0;
    std::size_t incomplete = 0;
    std::size_t comments = 0;
};
std::string comments_json(const std::vector<PacketComment>& comments);
std::string message_json(const InspectOrigin& origin, const inspect::Message& message);
std::string summary_json(const InspectSummary& summary);

}  // namespace echoloop::cli
