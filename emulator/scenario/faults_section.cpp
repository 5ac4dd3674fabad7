#include "emulator/scenario/faults_section.h"

#include <algorithm>

#include "emulator/contract/endpoint.h"
#include "emulator/scenario/device_section.h"

namespace echoloop::scenario {
namespace {

constexpr std::size_t most_faults = 1000;
constexpr double longest = 1e9;  // s

constexpr std::string_view common_keys[] = {"device", "kind",  "port", "direction", "from",
                                            "at",     "until", "for",  "every"};

std::vector<std::string_view> keys_of(const FaultRow* row) {
    std::vector<std::string_view> keys(std::begin(common_keys), std::end(common_keys));
    for (const FaultRow& any : fault_table()) {
        if (row != nullptr && any.kind != row->kind) continue;
        for (const Option& parameter : any.parameters) keys.push_back(parameter.name);
    }
    return keys;
}

std::vector<std::string_view> kind_names() {
    std::vector<std::string_view> names;
    for (const FaultRow& row : fault_table()) names.push_back(row.name);
    return names;
}

/// One fault on its way from keys and values to a Fault.
class FaultReader {
  public:
    FaultReader(const Value& value, const std::string& path, std::span<const ScenarioDevice> devices,
                bool all_devices, Problems& problems)
        : all_devices_(all_devices),
          row_(kind_of(value)),
          section_(&value, path, keys_of(row_), problems),
          devices_(devices),
          problems_(problems) {}

    Fault read(Time now);

  private:
    static const FaultRow* kind_of(const Value& value) {
        const Value* kind = value.find("kind");
        return kind != nullptr && kind->is_scalar() ? find_fault(kind->text) : nullptr;
    }
    void complain(std::string_view key, const std::string& message) {
        const Value* value = section_.get(key);
        problems_.add(value == nullptr ? section_.place() : value->place,
                      section_.path_of(key) + ": " + message);
    }
    bool has(std::string_view key) const { return section_.get(key) != nullptr; }
    void read_kind();
    void read_device();
    void read_port();
    void read_direction();
    void read_time(Time now);
    void read_end();
    void check_times();
    void check_needs();
    /// One that is out of range is replaced by one that no other check complains of.
    Time seconds(std::string_view key, double least, double fallback = longest) {
        return from_seconds(section_.number(key, fallback, {least, longest, "s"}));
    }

    bool all_devices_;  ///< false: some are missing, since they are themselves in error
    const FaultRow* row_;
    Section section_;
    std::span<const ScenarioDevice> devices_;
    Problems& problems_;
    const ScenarioDevice* device_ = nullptr;
    Fault fault_;
};

void FaultReader::read_kind() {
    if (!has("kind")) return complain("kind", "is missing; `echoloop list --faults` shows the kinds");
    std::string name = section_.word("kind", "", kind_names());
    if (row_ == nullptr) return;
    fault_.kind = row_->kind;
    for (const Option& parameter : row_->parameters)
        fault_.parameters[parameter.name] = read_option(parameter, section_, problems_);
}

void FaultReader::read_device() {
    if (!has("device")) return complain("device", "is missing; name the device that has the fault");
    fault_.device = section_.text("device", "");
    const auto found = std::ranges::find(devices_, fault_.device, &ScenarioDevice::name);
    if (found != devices_.end()) {
        device_ = &*found;
    } else if (all_devices_) {
        std::vector<std::string_view> names;
        for (const auto& device : devices_) names.push_back(device.name);
        complain("device", "unknown device " + in_quotes(fault_.device) + suggestion(fault_.device, names));
    }
}

void FaultReader::read_port() {
    fault_.port = section_.text("port", "");
    if (!has("port") || device_ == nullptr || device_->model->make == nullptr) return;
    try {
        const auto ports = device_->model->make(device_->config)->ports();
        if (std::ranges::find(ports, fault_.port, &Port::name) != ports.end()) return;
        std::vector<std::string_view> names;
        for (const Port& port : ports) names.push_back(port.name);
        complain("port", "unknown port " + in_quotes(fault_.port) + suggestion(fault_.port, names));
    } catch (const std::invalid_argument&) {  // the device's own section has said so
    }
}

void FaultReader::read_direction() {
    const auto word = section_.word("direction", "to_driver", {"to_driver", "from_driver", "both"});
    fault_.direction = word == "both"          ? Towards::both
                       : word == "from_driver" ? Towards::from_driver
                                               : Towards::to_driver;
    if (row_ != nullptr && row_->where != FaultRow::Where::bytes) fault_.direction = Towards::both;
    if (row_ == nullptr || !has("direction")) return;
    if (row_->where != FaultRow::Where::bytes)
        complain("direction", row_->name + " has no direction; remove it");
    if (row_->kind == FaultKind::wrong_checksum && fault_.direction != Towards::to_driver)
        complain("direction", "wrong_checksum is for what the device says; remove it");
}

void FaultReader::read_time(Time now) {
    fault_.from = now;
    for (const auto* key : {"from", "at"})
        if (has(key)) fault_.from = seconds(key, 0, 0);
    if (has("from") && has("at")) complain("at", "is another word for from; remove one of them");
    if (has("every")) fault_.every = seconds("every", 0.001);
    read_end();
    check_times();
}

void FaultReader::read_end() {
    if (row_ != nullptr && row_->momentary) {
        fault_.length = {};
        for (const auto* key : {"for", "until"})
            if (has(key)) complain(key, row_->name + " happens at one moment; remove it");
        return;
    }
    if (has("for")) fault_.length = seconds("for", 0.001);
    if (has("until")) fault_.length = seconds("until", 0) - fault_.from;
    if (has("for") && has("until")) complain("until", "says the same as for; remove one of them");
    if (fault_.length <= Time{}) complain(has("until") ? "until" : "for", "it ends before it begins");
}

void FaultReader::check_times() {
    if (row_ == nullptr) return;
    const bool endless = fault_.length == Time::max();
    if (row_->needs_end && endless)
        complain("for", "is missing; " + row_->name + " needs an end, e.g. for: 2");
    if (!has("every") || row_->momentary) return;
    if (endless) complain("every", "needs for, which says how long it lasts each time");
    if (!endless && fault_.every <= fault_.length)
        complain("every", "it comes again before it has ended; make it longer than for");
}

void FaultReader::check_needs() {
    if (row_ == nullptr || device_ == nullptr || row_->needs.empty()) return;
    const Model& model = *device_->model;
    const auto& endpoints = device_->config.endpoints;  // none: they have been complained of
    const auto has_scheme = [&](std::string_view start) {
        return endpoints.empty() || std::ranges::any_of(endpoints, [&](const Endpoint& endpoint) {
                   return scheme_name(endpoint.scheme).starts_with(start);
               });
    };
    bool good = true;
    if (row_->kind == FaultKind::wrong_checksum) good = model.has_checksums;
    if (row_->kind == FaultKind::bad_numbers) good = model.family == "nmea" || model.family == "altimeter";
    if (row_->kind == FaultKind::stuck_motor) good = model.turn_steps > 1;
    if (row_->kind == FaultKind::half_open || row_->kind == FaultKind::reset) good = has_scheme("tcp");
    if (row_->kind == FaultKind::baud_mismatch)
        good = device_->config.options.contains("baud") && (has_scheme("pty") || has_scheme("serial"));
    if (!good)
        complain("kind", row_->name + " is for devices with " + row_->needs + "; " +
                             in_quotes(fault_.device) + " (" + model.name + ") has none");
}

Fault FaultReader::read(Time now) {
    read_kind();
    read_device();
    read_port();
    read_direction();
    read_time(now);
    check_needs();
    return std::move(fault_);
}

Fault read_one(const Value& value, const std::string& path, std::span<const ScenarioDevice> devices,
               bool all_devices, Time now, Problems& problems) {
    if (!value.is_map()) {
        problems.add(value.place,
                     path +
                         ": expected keys and values, as in {device: micron, kind: loss, rate: 0.1}, got " +
                         describe(value));
        return {};
    }
    return FaultReader(value, path, devices, all_devices, problems).read(now);
}

}  // namespace

Fault read_fault(const Value& value, const std::string& path, std::span<const ScenarioDevice> devices,
                 Time now, Problems& problems) {
    return read_one(value, path, devices, true, now, problems);
}

std::vector<Fault> read_faults(const Value* value, std::span<const ScenarioDevice> devices,
                               Problems& problems) {
    std::vector<Fault> faults;
    if (value == nullptr || value->kind == Value::Kind::null) return faults;
    if (!value->is_sequence() || value->items.size() > most_faults) {
        problems.add(value->place, "faults: expected a list of up to 1000 faults, got " + describe(*value));
        return faults;
    }
    const bool all_devices = problems.empty();
    for (std::size_t i = 0; i < value->items.size(); ++i)
        faults.push_back(
            read_one(value->items[i], "faults." + std::to_string(i), devices, all_devices, Time{}, problems));
    return faults;
}

}  // namespace echoloop::scenario
