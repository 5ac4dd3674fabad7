#include "emulator/devices/waterlinked-dvl/dvl.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace echoloop::waterlinked_dvl {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t most_clients = 8;   // of a TCP port; own choice, "several" by the documentation
constexpr double hot = 50, too_hot = 55;  // degC; it starts again below `hot`
constexpr Time document_patience = 1s, line_patience = 100ms;  // for the rest of a command
constexpr Time reset_delay = 50ms;
constexpr Time empty_interval = 500ms;

/// s between pings without a bottom: invalid lines of published samples come every 0.43 to 1.25 s.
double search_interval(double farthest, double highest) {
    return 0.43 + 0.82 * std::min(farthest / highest, 1.0);
}

Bytes as_bytes(const std::string& text) { return {text.begin(), text.end()}; }

std::size_t http_port(const Wiring& wiring) {
    return static_cast<std::size_t>(std::ranges::find(wiring.ports, Speech::http) - wiring.ports.begin());
}

}  // namespace

Dvl::Dvl(const Settings& settings, const Wiring& wiring)
    : settings_(settings),
      wiring_(wiring),
      web_(http_port(wiring)),
      modes_(range_modes(settings.acoustics.highest_altitude)),
      pacer_(settings.sensors, jitter::processor),
      measurement_(settings) {
    state_.configuration = settings.start;
    state_.output = settings.serial_output;
    state_.address = wiring.address;
    restart_search();
}

std::vector<Port> Dvl::ports() const {
    std::vector<Port> all;
    for (const Speech speech : wiring_.ports) {
        constexpr const char* names[] = {"json", "http", "pd6", "pd4", "line"};
        Port port{names[static_cast<std::size_t>(speech)], Port::Kind::stream, {}, false};
        if (speech != Speech::serial) {
            port.drivers = most_clients;
            port.messages_kept = speech == Speech::http ? 0 : 32;
        }
        port.answers_half_closed = port.speaks_http = speech == Speech::http;
        all.push_back(port);
    }
    return all;
}

Actions Dvl::started(Time now) {
    boot_end_ = now + from_seconds(settings_.boot_time);
    next_position_ = last_report_ = boot_end_;
    return woken(now);
}

Actions Dvl::connected(std::size_t port, Address peer, Time now) {
    if (wiring_.ports.at(port) == Speech::http) web_.connected(peer, now);
    ++clients_[port];
    return take_actions(now);
}

Actions Dvl::disconnected(std::size_t port, Address peer, Time now) {
    if (wiring_.ports.at(port) == Speech::http) web_.disconnected(peer);
    hosts_.erase({port, peer});
    if (clients_[port] > 0) --clients_[port];
    return take_actions(now);
}

void Dvl::reconnected(std::size_t port) {
    std::erase_if(hosts_, [port](const auto& host) { return host.first.port == port; });
}

Actions Dvl::received(const Received& data, Time now) {
    if (boots(now)) {
        counters_.skipped_bytes += data.bytes.size();
        return take_actions(now);
    }
    state_.unix_now = settings_.unix_start + to_seconds(now);
    const Peer host{data.port, data.from};
    const Configuration before = state_.configuration;
    switch (wiring_.ports.at(data.port)) {
        case Speech::http:
            read_pages(data, now);
            break;
        case Speech::json:
            hosts_[host].feed(data.bytes, now);
            read_documents(host, now);
            break;
        case Speech::serial:
            hosts_[host].feed(data.bytes, now);
            read_lines(host, now);
            break;
        default:  // nobody is heard there
            counters_.skipped_bytes += data.bytes.size();
    }
    after_command(before, now);
    return take_actions(now);
}

void Dvl::read_documents(Peer host, Time now) {
    HostText& text = hosts_[host];
    if (settings_.strict_read) return obey(answer(text.take_all(), state_, settings_), host, now);
    while (const auto document = text.next_document()) obey(answer(*document, state_, settings_), host, now);
}

void Dvl::read_lines(Peer host, Time now) {
    while (const auto line = hosts_[host].next_line())
        obey(answer_sentence(*line, state_, settings_), host, now);
}

void Dvl::obey(Answer answer, Peer host, Time now) {
    ++(answer.good ? counters_.messages : counters_.rejected);
    if (state_.reset) reset_at_ = now + reset_delay;
    if (state_.calibrate) calibrated_at_ = now + from_seconds(answer.after);
    state_.reset = state_.calibrate = false;
    actions_.send.push_back(
        {host.port, as_bytes(answer.text), host.address, now + from_seconds(answer.after)});
}

void Dvl::after_command(const Configuration& before, Time now) {
    if (state_.configuration.range_mode != before.range_mode) restart_search();
    if (state_.configuration.acoustic_enabled) state_.triggers = 0;
    plan(now);
    ping_if_due(now);
}

/// The rest of a command never came.
void Dvl::expire(Time now) {
    for (auto& [host, text] : hosts_) {
        const bool line = wiring_.ports.at(host.port) == Speech::serial;
        if (text.empty() || now < text.since() + (line ? line_patience : document_patience)) continue;
        const std::string rest = text.take_all();
        obey(line ? answer_sentence("", state_, settings_) : answer(rest, state_, settings_), host, now);
    }
}

void Dvl::read_pages(const Received& data, Time now) {
    for (const http::Request& request : web_.received(data.from, data.bytes, now, actions_)) {
        const bool foreign = !settings_.any_page && http::is_of_foreign_page(request);
        ++(foreign ? counters_.rejected : counters_.messages);
        Bytes response =
            foreign ? http::response(403) : page(request, state_, outputs(), settings_, inside(now));
        actions_.send.push_back({data.port, std::move(response), data.from, {}, true});
    }
}

std::vector<OutputRow> Dvl::outputs() const {
    std::vector<OutputRow> rows;
    for (std::size_t port = 0; port < wiring_.ports.size(); ++port) {
        const auto clients = clients_.find(port);
        const std::size_t count = clients == clients_.end() ? 0 : clients->second;
        const int number = wiring_.numbers.at(port);
        switch (wiring_.ports[port]) {
            case Speech::json:
                rows.push_back({"tcp_water_linked", number, std::string(settings_.format()), count});
                break;
            case Speech::pd6:
                rows.push_back({"tcp_pd6", number, "pd6", count});
                break;
            case Speech::pd4:
                rows.push_back({"tcp_pd4", number, "pd4", count});
                break;
            case Speech::serial:
                rows.push_back({"serial", 0, "serial", 0});
                break;
            case Speech::http:
                break;
        }
    }
    return rows;
}

bool Dvl::pings() const {
    return (state_.configuration.acoustic_enabled || state_.triggers > 0) && settings_.temperature < too_hot;
}

void Dvl::plan(Time now) {
    if (boots(now)) return;
    if (!pings()) {
        pacer_.pause();
        const bool says_so = settings_.invalid_lines_when_off && !state_.configuration.acoustic_enabled;
        if (!says_so) next_empty_ = Time::max();
        if (says_so && next_empty_ == Time::max()) next_empty_ = now;
        return;
    }
    next_empty_ = Time::max();
    if (!pacer_.under_way() && pacer_.wake() == Time::max()) pacer_.start(now, from_seconds(plan_.period));
}

void Dvl::restart_search() {
    const RangeMode& mode = state_.configuration.range_mode;
    search_.restart(mode.lowest, mode.highest);
}

Mode Dvl::mode_of_next(Time now) {
    if (sends_water()) return water_layer;
    return modes_.at(search_.next(state_.configuration.periodic_cycling_enabled, now));
}

void Dvl::ping_if_due(Time now) {
    if (boots(now) || !pings() || !pacer_.begin(now)) return;
    triggered_ = !state_.configuration.acoustic_enabled;
    if (triggered_) --state_.triggers;
    plan_ = make_plan(mode_of_next(now), state_.configuration.speed_of_sound, settings_);
    if (!sends_water() && !search_.locked()) {
        const double searching = search_interval(plan_.mode.farthest, settings_.acoustics.highest_altitude);
        plan_.period = std::max(plan_.period, triggered_ ? 0 : searching);
    }
    ++shots_;
    constexpr Stray latency{.noise = 2e-3};  // s; the documentation has 4 ms in the mean, 13 at most
    const double processing =
        settings_.processing_time +
        std::clamp(settings_.sensors.read("latency", 0, latency, now), -settings_.processing_time, 9e-3);
    actions_.ping = Ping{make_shot(plan_, settings_, shots_), now + from_seconds(plan_.window + processing)};
}

Actions Dvl::heard(const Echogram& echogram, Time now) {
    const Time began = pacer_.began().value_or(now);
    if (!pacer_.end(now, from_seconds(plan_.period))) return take_actions(now);
    ++counters_.pings;
    if (echogram.beams() == settings_.azimuths.size()) {
        const Configuration& set = state_.configuration;
        VelocityReport report{measurement_.measure(
            echogram, {set.speed_of_sound, deg_to_rad(set.mounting_rotation_offset), set.range_mode.water},
            plan_, began)};
        const double reflection =
            measurement_.echo_time() > 0 ? measurement_.echo_time() / 2 : plan_.window / 2;
        const Time validity = began + from_seconds(reflection);
        if (!report.water) {
            const auto altitude = report.altitude > 0 ? std::optional(report.altitude) : std::nullopt;
            search_.found(altitude, modes_, now);
        }
        if (report.water || !search_.lost()) {
            measurement_.follow(report, validity);
            report.time = 1e3 * to_seconds(now - last_report_);
            report.validity = unix_us(validity);
            report.transmission = unix_us(now);
            report.status = inside(now) >= hot ? 1 : 0;
            last_report_ = now;
            send_report(report);
        }
    }
    plan(now);
    ping_if_due(now);
    return take_actions(now);
}

Actions Dvl::woken(Time now) {
    if (boots(now)) return take_actions(now);
    if (now >= reset_at_) {
        measurement_.reset();
        reset_at_ = Time::max();
    }
    if (now >= calibrated_at_) {
        measurement_.calibrate_gyro(now);
        calibrated_at_ = Time::max();
    }
    state_.unix_now = settings_.unix_start + to_seconds(now);
    web_.woken(now, actions_);
    expire(now);
    plan(now);
    ping_if_due(now);
    if (now >= next_empty_) {
        VelocityReport report{doppler::Measurement::nothing(settings_, settings_.start.speed_of_sound)};
        report.time = 1e3 * to_seconds(now - last_report_);
        report.validity = report.transmission = unix_us(now);
        last_report_ = now;
        next_empty_ = now + empty_interval;
        send_report(report);
    }
    if (now >= next_position_) {
        next_position_ += from_seconds(1 / settings_.position_rate);
        send_position(now);
    }
    return take_actions(now);
}

void Dvl::send_report(const VelocityReport& report) {
    tell(Speech::json, json_line(report, settings_));
    tell(Speech::pd6, pd6_lines(report, settings_));
    tell(Speech::pd4, pd4_block(report, settings_));
    switch (state_.output) {
        case SerialOutput::v1_and_v2:
            tell(Speech::serial, serial_v2(report) + serial_v1(report));
            break;
        case SerialOutput::v2:
            tell(Speech::serial, serial_v2(report));
            break;
        case SerialOutput::pd6:
            tell(Speech::serial, pd6_lines(report, settings_));
            break;
        case SerialOutput::pd4:
            tell(Speech::serial, pd4_block(report, settings_));
            break;
        case SerialOutput::off:
            break;
    }
}

void Dvl::send_position(Time now) {
    PositionReport report;
    report.local = measurement_.position();
    report.time = settings_.position_in_uptime ? to_seconds(now) : 1e-6 * static_cast<double>(unix_us(now));
    report.status = inside(now) >= hot ? 1 : 0;
    tell(Speech::json, json_line(report, settings_));
    if (state_.output == SerialOutput::v1_and_v2 || state_.output == SerialOutput::v2)
        tell(Speech::serial, serial_line(report));
}

void Dvl::tell(Speech speech, const std::string& text) { tell(speech, as_bytes(text)); }

void Dvl::tell(Speech speech, const Bytes& bytes) {
    for (std::size_t port = 0; port < wiring_.ports.size(); ++port)
        if (wiring_.ports[port] == speech) actions_.send.push_back({port, bytes, {}, {}});
}

double Dvl::inside(Time now) const {
    return settings_.sensors.read("inside", settings_.temperature, stray::board_temperature, now);
}

std::int64_t Dvl::unix_us(Time at) const {
    const double start = settings_.unix_start + state_.clock_error, whole = std::floor(start);
    return static_cast<std::int64_t>(whole) * 1'000'000 + std::llround((start - whole) * 1e6) +
           at.count() / 1000;
}

DeviceCounters Dvl::counters() const {
    DeviceCounters all = counters_;
    all.rejected += web_.refused();
    return all;
}

Actions Dvl::take_actions(Time now) {
    Time wake =
        std::min({pacer_.wake(), web_.wake(), next_position_, reset_at_, calibrated_at_, next_empty_});
    for (const auto& [host, text] : hosts_) {
        const bool line = wiring_.ports.at(host.port) == Speech::serial;
        if (!text.empty()) wake = std::min(wake, text.since() + (line ? line_patience : document_patience));
    }
    if (boots(now)) wake = boot_end_;
    actions_.wake = wake;
    return std::exchange(actions_, {});
}

}  // namespace echoloop::waterlinked_dvl
