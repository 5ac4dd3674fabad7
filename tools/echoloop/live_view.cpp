#include "tools/echoloop/live_view.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "emulator/run/token.h"
#include "emulator/scenario/control_place.h"
#include "emulator/scenario/fault_kinds.h"
#include "emulator/transport/address.h"
#include "emulator/transport/own_folder.h"
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
    constexpr double rare = 0.01, seen = 0.3;  // of messages; of bits the first is often enough
    Json parameters = Json::object();
    for (const Option& option : row.parameters)
        if (option.name == "rate")
            parameters["rate"] = std::get<double>(option.default_value) < rare ? rare : seen;
    return parameters;
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json devices_of(const Scenario& scenario) {
    Json devices = Json::array();
    for (const ScenarioDevice& device : scenario.devices) {
        Json places = Json::array();
        for (const WirePlace& place : wire_places(device)) places.push_back(place_line(place));
        devices.push_back({{"name", device.name},
                           {"model", device.model->name},
                           {"title", device.model->title},
                           {"sonar", device.model->default_shot != nullptr},
                           {"places", places}});
    }
    return devices;
}

Json kinds_of_faults() {
    Json faults = Json::array();
    for (const FaultRow& row : fault_table())
        faults.push_back({{"name", row.name},
                          {"help", row.help},
                          {"momentary", row.momentary},
                          {"parameters", parameters_of(row)}});
    return faults;
}

/// "tank-20261127-034500.pcapng", in UTC.
std::string file_name(const std::string& name) {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "-%Y%m%d-%H%M%S", &utc);
    return name + text + ".pcapng";
}

/// Of the page at a port that the user names: the same for all runs there, so that an open page finds the
/// next one. In a file that is the user's alone.
std::string kept_token(std::uint16_t port) {
    namespace fs = std::filesystem;
    const fs::path file = place_of_ones_own() / ("view-" + std::to_string(port));
    make_own_folder(file.parent_path(), "the token of --view-at", "port 0");
    constexpr std::size_t digits = 32;
    std::string token;
    if (fs::is_regular_file(fs::symlink_status(file))) std::ifstream(file) >> token;
    if (token.size() == digits && token.find_first_not_of("0123456789abcdef") == std::string::npos)
        return token;
    token = random_token();
    std::error_code ec;
    fs::remove(file, ec);
    const int made =
        ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR);
    const std::string line = token + "\n";
    const bool written =
        made >= 0 && ::write(made, line.data(), line.size()) == static_cast<ssize_t>(line.size());
    if (made >= 0) ::close(made);
    if (!written)
        throw StartError(Exit::cannot_create, file.string() +
                                                  ": the token of --view-at cannot be kept; make "
                                                  "room, or name port 0");
    return token;
}

std::string folder_from(const Arguments& arguments) {
    if (!arguments.has("--view-record")) return "";
    std::string folder = arguments.text("--view-record");
    std::error_code ec;
    if (!std::filesystem::is_directory(folder, ec))
        throw StartError(Exit::usage, "--view-record: there is no folder '" + folder + "'; make it first");
    return folder;
}

}  // namespace

LiveView::LiveView(const Arguments& arguments, bool always)
    : wanted_(always || arguments.has("--view")),
      control_(arguments.has("--view-control")),
      address_(address_from(arguments)),
      folder_(folder_from(arguments)) {
    const bool more = control_ || arguments.has("--view-at") || !folder_.empty();
    if (!wanted_ && more)
        throw StartError(Exit::usage,
                         "--view-at, --view-control and --view-record say how the page is served; give "
                         "--view too");
    if (folder_.empty()) return;
    if (!control_)
        throw StartError(Exit::usage,
                         "--view-record lets the page begin a recording; give --view-control too");
    if (arguments.has("--record"))
        throw StartError(Exit::usage,
                         "--record and --view-record: a run has one recording; give one of them");
    recording_ = std::make_unique<Recording>(RecordingLimits{});
}

view::ServerOptions LiveView::options() {
    view::ServerOptions options;
    options.address = address_;
    options.control = control_;
    if (address_.port != 0) options.token = kept_token(address_.port);
    return options;
}

std::unique_ptr<view::Server> LiveView::serve(Runtime& runtime) {
    if (!wanted_) return nullptr;
    const Scenario& scenario = runtime.scenario();
    name_ = scenario.file.stem().string();
    view::ServerOptions options = this->options();
    options.hello = text_of(Json{{"type", "hello"},
                                 {"version", ECHOLOOP_VERSION},
                                 {"scenario", scenario.file.filename().string()},
                                 {"captured", false},
                                 {"control", control_},
                                 {"record", recording_ != nullptr},
                                 {"devices", devices_of(scenario)},
                                 {"faults", kinds_of_faults()}});
    options.scene = view::scene_message(*runtime.scene(), scenario.scene.string());
    options.about = about(runtime);
    options.ask = [this, &runtime](const std::string& line, std::function<void(std::string)> answer) {
        const Json asked = Json::parse(line, nullptr, false);
        if (recording_ && asked.is_object() && asked.contains("record"))
            return answer(switch_recording(asked["record"] == true));
        if (!recording_ || !asked.is_object() || !asked.contains("status"))
            return runtime.ask(line, std::move(answer));
        const std::string file = recording_->is_idle() ? "" : recording_->file().string();
        runtime.ask(line, [file, answer = std::move(answer)](const std::string& text) {
            Json status = Json::parse(text, nullptr, false);
            if (status.is_object()) status["recording"] = file;
            answer(text_of(status));
        });
    };
    for (const ScenarioDevice& device : scenario.devices)
        options.families[device.name] = std::string(device.model->family);
    return std::make_unique<view::Server>(feed_, std::move(options));
}

std::unique_ptr<view::Server> LiveView::serve(const std::string& file, const std::vector<ShownPort>& ports) {
    if (!wanted_) return nullptr;
    view::ServerOptions options = this->options();
    Json devices = Json::array();
    for (const ShownPort& port : ports) {
        const auto* family = port.family;
        devices.push_back({{"name", port.name},
                           {"model", ""},
                           {"title", family != nullptr ? std::string(family->title) : "of no known family"},
                           {"places", Json::array()}});
        if (family != nullptr) options.families[port.name] = std::string(family->name);
    }
    options.hello = text_of(Json{{"type", "hello"},
                                 {"version", ECHOLOOP_VERSION},
                                 {"scenario", std::filesystem::path(file).filename().string()},
                                 {"captured", true},
                                 {"control", false},
                                 {"record", false},
                                 {"devices", devices},
                                 {"faults", Json::array()}});
    options.ask = [](const std::string&, const std::function<void(std::string)>& answer) {
        answer(R"({"ok": true, "t": 0, "devices": []})");
    };
    options.about.families = options.families;
    return std::make_unique<view::Server>(feed_, std::move(options));
}

/// On the server's thread: a slow disk delays the page alone.
std::string LiveView::switch_recording(bool on) {
    try {
        if (!on) {
            recording_->finish();
            const RecordingSummary s = recording_->summary();
            return text_of(
                Json{{"ok", true}, {"recorded", recording_->file().string()}, {"packets", s.packets}});
        }
        recording_->begin(std::filesystem::path(folder_) / file_name(name_));
        return text_of(Json{{"ok", true}, {"recording", recording_->file().string()}});
    } catch (const StartError& error) {
        return text_of(Json{{"ok", false}, {"error", error.what()}});
    }
}

std::vector<Argument> view_arguments(const std::string& what) {
    using Kind = Argument::Kind;
    return {{Kind::flag, "--view", "",
             "show " + what + " on a page in a browser; its link is printed (docs/view.md)"},
            {Kind::value, "--view-at", "ADDRESS:PORT",
             "where the page is, instead of a free port of 127.0.0.1; others on the network need the link, "
             "too"}};
}

}  // namespace echoloop::cli
