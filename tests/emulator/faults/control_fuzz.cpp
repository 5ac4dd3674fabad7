// libFuzzer: any text as a line of the control socket. What is accepted must be a fault that can be made.
#include <cstdint>
#include <cstdlib>

#include "emulator/faults/control_line.h"
#include "emulator/faults/pieces.h"

namespace {

using namespace echoloop;

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
        device.config.endpoints = {endpoint};
        device.config.options = {{"baud", 115200.0}};
        devices.push_back(std::move(device));
    }
    return devices;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto known = devices();
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto [request, reason] = parse_control_line(text, known, from_seconds(1));
    if (request.has_value() == !reason.empty()) std::abort();
    if (!request || request->what != ControlRequest::What::fault) return 0;
    Faults faults(1, "", nullptr);
    faults.add(request->fault);
    Pieces pieces(faults.of(request->fault.device), {request->fault.device, "line", Towards::to_driver},
                  {true, nullptr, 9600});
    for (int i = 0; i < 3; ++i) pieces.add(Bytes(100, 7), {}, from_seconds(i));
    while (const auto due = pieces.next_due())
        while (pieces.take(*due)) {
        }
    return 0;
}
