// libFuzzer: any text as lines of the control socket. What is accepted must be faults that can be made, all
// together, on what a device says and on what it hears, in bounded memory.
#include <cstdint>
#include <cstdlib>

#include "emulator/faults/control_line.h"
#include "emulator/faults/pieces.h"
#include "emulator/run/answers.h"

namespace {

using namespace echoloop;

void require(bool good) {
    if (!good) std::abort();
}

/// One that can have every fault.
const Model& turner() {
    static const Model model = [] {
        Model turning{"ping360", "", "", {}, {}, {}};
        turning.turn_steps = 400;
        return turning;
    }();
    return model;
}

std::vector<ScenarioDevice> devices() {
    std::vector<ScenarioDevice> devices;
    for (const char* endpoint : {"tcp-listen://127.0.0.1:0", "pty:/tmp/a"}) {
        ScenarioDevice device;
        device.name = devices.empty() ? "a" : "b";
        device.model = &turner();
        device.config.name = device.name;
        device.config.endpoints = {parse_endpoint(endpoint)};
        device.config.options = {{"baud", 115200.0}};
        devices.push_back(std::move(device));
    }
    return devices;
}

void ask(std::string_view text, Faults& faults) {
    static const auto known = devices();
    const auto [request, reason] = parse_control_line(text, known, from_seconds(1));
    require(request.has_value() == reason.empty());
    if (!request) return answers::refusal(reason).empty() ? std::abort() : void();
    if (request->what == ControlRequest::What::fault) faults.add(request->fault);
    if (request->what != ControlRequest::What::clear) return;
    request->id ? static_cast<void>(faults.clear(*request->id)) : static_cast<void>(faults.clear_all());
}

void make(DeviceFaults& faults, Towards direction, ByteView message) {
    Pieces pieces(faults, {faults.name(), "line", direction}, {true, find_checksums("ping"), 9600});
    constexpr std::size_t most_memory = std::size_t{256} << 20;
    std::size_t held = 0;
    const auto take = [&](Time now) {
        while (const auto piece = pieces.take(now)) {
            held += piece->bytes.size() + piece->events.size() * sizeof(FaultEvent);
            for (const FaultEvent& event : piece->events) require(event.offset <= piece->bytes.size());
        }
    };
    for (int i = 0; i < 4; ++i) {
        pieces.add(i == 3 ? ByteView(Bytes(100, 7)) : message, {}, from_seconds(i));
        take(from_seconds(i + 0.3));
    }
    while (const auto due = pieces.next_due()) take(*due);
    require(pieces.idle() && held < most_memory);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Faults faults(1, "", nullptr);
    std::string_view text(reinterpret_cast<const char*>(data), size);
    for (int lines = 0; lines < 8 && !text.empty(); ++lines) {
        const auto line = text.substr(0, text.find('\n'));
        ask(line, faults);
        text.remove_prefix(std::min(text.size(), line.size() + 1));
    }
    require(!answers::list(faults, from_seconds(2)).empty());
    for (const char* device : {"a", "b"})
        for (const Towards direction : {Towards::to_driver, Towards::from_driver})
            make(faults.of(device), direction, {data, std::min<std::size_t>(size, 2000)});
    return 0;
}
