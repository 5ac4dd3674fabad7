#include "tools/echoloop/live_view.h"

#include <nlohmann/json.hpp>

#include "emulator/scenario/control_place.h"
#include "emulator/scenario/fault_kinds.h"
#include "emulator/transport/address.h"
#include "tools/echoloop/driver.h"
#include "tools/echoloop/run_bag.h"
#include "tools/view/scene_message.h"

namespace echoloop::cli {
namespace {

using Json = nlohmann::ordered_json;

Address address_from(const Arguments& arguments) {
    constexpr std::uint32_t loopback = 127U << 24 | 1U;
    if (!arguments.has("--view-at")) return {loopback, 0};
    const std::string text = arguments.text("--view-at");
    const auto colon = text.rfind(':');
    error_code ec;
    const auto ip = asio::ip::make_address_v4(text.substr(0, colon), ec);
    const std::string digits = colon == std::string::npos ? "" : text.substr(colon + 1);
    const bool number = !digits.empty() && digits.size() <= 5 &&
                        digits.find_first_not_of("0123456789") == std::string::npos &&
                        std::stoul(digits) <= 65535;
    if (ec || !number)
        throw StartError(
            Exit::usage,
            "--view-at: expected an address and a port such as 127.0.0.1:8080, got '" + text + "'");
    return {ip.to_uint(), static_cast<std::uint16_t>(std::stoul(digits))};
}

/// A button's: what the kind takes by default, but so often that somebody who looks sees it.
Json parameters_of(const FaultRow& row) {
    constexpr double rare = 0.01, seen = 0.3;
    Json parameters = Json::object();
    for (const Option& option : row.parameters)
        if (option.name == "rate" && std::get<double>(option.default_value) == rare)
            parameters["rate"] = seen;
    return parameters;
}

std::string hello(const Runtime& runtime, bool control) {
    const Scenario& scenario = runtime.scenario();
    Json devices = Json::array(), faults = Json::array();
    for (const ScenarioDevice& device : scenario.devices) {
        Json places = Json::array();
        for (const WirePlace& place : wire_places(device)) places.push_back(place_line(place));
        devices.push_back({{"name", device.name}, {"title", device.model->title}, {"places", places}});
    }
    for (const FaultRow& row : fault_table())
        faults.push_back({{"name", row.name},
                          {"help", row.help},
                          {"momentary", row.momentary},
                          {"parameters", parameters_of(row)}});
    const Json all{
        {"type", "hello"},    {"version", ECHOLOOP_VERSION}, {"scenario", scenario.file.filename().string()},
        {"control", control}, {"devices", devices},          {"faults", faults}};
    return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

LiveView::LiveView(const Arguments& arguments)
    : wanted_(arguments.has("--view")),
      control_(arguments.has("--view-control")),
      address_(address_from(arguments)) {
    if (!wanted_ && (control_ || arguments.has("--view-at")))
        throw StartError(Exit::usage,
                         "--view-at and --view-control say how the page is served; give --view too");
}

std::unique_ptr<view::Server> LiveView::serve(Runtime& runtime) {
    if (!wanted_) return nullptr;
    view::ServerOptions options{
        .address = address_,
        .hello = hello(runtime, control_),
        .scene = view::scene_message(*runtime.scene(), runtime.scenario().scene.string()),
        .families = {},
        .about = about(runtime),
        .ask =
            [&runtime](std::string line, std::function<void(std::string)> answer) {
                runtime.ask(std::move(line), std::move(answer));
            },
        .control = control_};
    for (const ScenarioDevice& device : runtime.scenario().devices)
        options.families[device.name] = std::string(device.model->family);
    return std::make_unique<view::Server>(feed_, std::move(options));
}

}  // namespace echoloop::cli
