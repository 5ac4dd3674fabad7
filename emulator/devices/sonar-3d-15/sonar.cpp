#include "emulator/devices/sonar-3d-15/sonar.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "emulator/contract/endpoint.h"
#include "emulator/devices/sonar-3d-15/api.h"
#include "protocols/sonar3d/codec.h"

namespace echoloop::sonar_3d_15 {
namespace {

using namespace std::chrono_literals;

enum PortIndex : std::size_t { http_port, image_port };

constexpr Address multicast{0xE0000060, 4747};  // 224.0.0.96
constexpr Time request_patience = 5s;
constexpr float pixel_scale = 50.0F / 65536;        // m
constexpr double salt_water = 35, fresh_water = 0;  // ppt
constexpr std::uint32_t frequency_of_real_ones = 5;
constexpr Time imu_period = 10ms;
constexpr int imu_samples = 10;            // of a batch
constexpr double first_time = 1735689600;  // 2025-01-01, of a clock that nobody has set

sonar3d::Timestamp unix_time(double unix_start, Time at) {
    const auto start = static_cast<std::int64_t>(std::floor(unix_start));
    const Time within = at + from_seconds(unix_start - static_cast<double>(start));
    const std::int64_t seconds = std::chrono::floor<std::chrono::seconds>(within).count();
    return {start + seconds, static_cast<std::int32_t>((within - std::chrono::seconds(seconds)).count())};
}

float degrees(double angle) { return static_cast<float>(rad_to_deg(angle)); }

}  // namespace

Sonar::Sonar(const Settings& settings, const Wiring& wiring)
    : settings_(settings), wiring_(wiring), state_(settings.start), speed_(speed_of(settings.start)) {
    view_is_high_ = state_.high;
    view_ = make_view(settings_.mode(state_.high), settings_.first_row_up);
    if (settings_.release >= with_time && !settings_.ntp_reached)
        state_.clock_error = first_time - settings_.unix_start;
    if (wiring_.unicast_ip.empty()) return;
    state_.udp = UdpMode::unicast;
    state_.unicast_ip = wiring_.unicast_ip;
    state_.unicast_port = wiring_.unicast_port;
}

std::vector<Port> Sonar::ports() const {
    Port http{"http", Port::Kind::stream, {}, false};
    http.drivers = 4;
    http.answers_half_closed = true;
    http.speaks_http = true;
    return {http, {"images", Port::Kind::datagram, {wiring_.own.ip, 0}, false}};
}

Actions Sonar::started(Time now) {
    restart(now);
    plan_imu(now);
    return take_actions();
}

/// Who connects and asks nothing must not keep others out.
Actions Sonar::connected(std::size_t port, Address peer, Time now) {
    if (port == http_port) clients_[peer].deadline = now + request_patience;
    return take_actions();
}

Actions Sonar::disconnected(std::size_t port, Address peer, Time) {
    if (port == http_port) clients_.erase(peer);
    return take_actions();
}

Actions Sonar::received(const Received& data, Time now) {
    if (data.port != http_port) return take_actions();
    Client& client = clients_[data.from];
    client.reader.feed(data.bytes);
    while (const auto next = client.reader.next()) {
        client.deadline = Time::max();
        if (const auto* request = std::get_if<http::Request>(&*next)) {
            obey(*request, data.from, now);
            continue;
        }
        ++counters_.rejected;
        respond(http::response(std::get<http::Refusal>(*next).status), data.from);
    }
    if (client.reader.pending_bytes() > 0)  // a byte now and then buys no more time
        client.deadline = std::min(client.deadline, now + request_patience);
    return take_actions();
}

void Sonar::obey(const http::Request& request, Address from, Time now) {
    if (!settings_.any_page && http::is_of_foreign_page(request)) {
        ++counters_.rejected;
        return respond(http::response(403), from);
    }
    state_.temperature =
        settings_.sensors.read("inside", settings_.temperature, stray::board_temperature, now);
    const State before = state_;
    state_.unix_now = settings_.unix_start + to_seconds(now);
    const Answer reply = answer(request, state_, settings_);
    ++(reply.status < 300 ? counters_.messages : counters_.rejected);
    respond(http::response(reply.status, reply.body), from, now + from_seconds(reply.after));
    if (state_.imu != before.imu) plan_imu(now);
    if (speed_of(state_) != speed_of(before)) speed_change_ = now + from_seconds(settings_.speed_delay);
    const bool other_image = state_.enabled != before.enabled || state_.high != before.high ||
                             state_.range_min != before.range_min || state_.range_max != before.range_max;
    if (other_image) restart(now);
}

double Sonar::speed_of(const State& state) const {
    if (state.speed > 0) return state.speed;
    return automatic_speed(settings_.water_temperature, state.salt ? salt_water : fresh_water);
}

/// Drops the image under way; its shot is waited for, since there is one at a time.
void Sonar::restart(Time now) {
    shooting_.reset();
    if (state_.enabled && !ping_under_way_) begin_image(now);
}

void Sonar::begin_image(Time now) {
    if (now >= speed_change_) {
        speed_ = speed_of(state_);
        speed_change_ = Time::max();
    }
    if (view_is_high_ != state_.high) {
        view_is_high_ = state_.high;
        view_ = make_view(settings_.mode(state_.high), settings_.first_row_up);
    }
    ++shots_;
    shooting_ = Shooting{make_plan(state_, speed_, settings_), now};
    ping_under_way_ = true;
    // The intervals between the six images of a recording differ by 1.0 ms.
    constexpr Jitter jitter{10us, 60};
    const Time late = settings_.sensors.lateness(jitter, shots_),
               next_late = settings_.sensors.lateness(jitter, shots_ + 1);
    actions_.ping = Ping{make_shot(shooting_->plan, view_, settings_, shots_),
                         now - late + from_seconds(shooting_->plan.period) + next_late};
}

Actions Sonar::heard(const Echogram& echogram, Time now) {
    if (!ping_under_way_ || echogram.shot.ping != shots_) return take_actions();
    ping_under_way_ = false;
    imu_.turned(echogram.world_from_sonar.orientation, now);
    if (shooting_ && echogram.beams() == width * height && echogram.shot.bins == shooting_->plan.bins)
        send_image(echogram);
    restart(now);
    return take_actions();
}

void Sonar::send_image(const Echogram& echogram) {
    ++counters_.pings;
    const std::uint32_t number = images_++;
    const auto to = destination();
    if (!to) return;
    const Plan& plan = shooting_->plan;
    std::vector<std::uint32_t> distances(width * height, 0);
    wire::Bytes strengths(width * height, 0);
    for (std::size_t beam = 0; beam < width * height; ++beam) {
        const auto pixel = strongest(echogram, beam, plan, settings_);
        if (!pixel) continue;
        // Own choice: with it, flat walls have as many equal neighbours as a recording.
        constexpr Stray echo{.noise = 0.05};
        const Time own{static_cast<Time::rep>(beam)};
        double told = settings_.sensors.read("range", pixel->distance, echo, shooting_->start + own);
        if (told < plan.range_min || told > plan.range_max)  // no bin is there
            told = pixel->distance;
        const double stepped = range_step * std::round(told / range_step);
        const long counts = std::lround(stepped / static_cast<double>(pixel_scale));
        distances[view_.pixel_of(beam)] = static_cast<std::uint32_t>(std::clamp(counts, 1L, 65535L));
        strengths[view_.pixel_of(beam)] = pixel->strength;
    }
    distances = smoothed(std::move(distances));
    const ModeFigures& mode = settings_.mode(plan.high);
    const auto fill = [&](auto& message) {
        message.header = {time_of(shooting_->start), number};
        message.speed_of_sound = static_cast<float>(plan.speed);
        message.range = static_cast<float>(plan.range_max);
        message.frequency = settings_.frequency_in_hertz ? static_cast<std::uint32_t>(mode.frequency)
                                                         : frequency_of_real_ones;
        message.width = width;
        message.height = height;
        message.fov_horizontal = degrees(mode.fov_horizontal);
        message.fov_vertical = degrees(mode.fov_vertical);
    };
    sonar3d::RangeImage ranges;
    fill(ranges);
    ranges.image_pixel_scale = pixel_scale;
    ranges.image_pixel_data = std::move(distances);
    send_packet(std::move(ranges), *to);
    sonar3d::BitmapImage bitmap;
    fill(bitmap);
    bitmap.image_pixel_data = std::move(strengths);
    send_packet(std::move(bitmap), *to);
    if (settings_.other_messages) send_packet(sonar3d::OtherMessage{{0x08, 0x01}}, *to);
}

void Sonar::send_packet(sonar3d::Message message, Address to) {
    std::string url = sonar3d::type_url(settings_.package, message);
    if (std::holds_alternative<sonar3d::OtherMessage>(message))
        url = "type.googleapis.com/" + settings_.package + ".Undocumented";
    actions_.send.push_back(
        {image_port, sonar3d::serialise({settings_.version, url, std::move(message)}), to, {}});
}

/// A sonar on a loopback address sends to loopback only; what it multicasts stays there.
std::optional<Address> Sonar::destination() const {
    if (state_.udp == UdpMode::disabled) return std::nullopt;
    if (state_.udp == UdpMode::multicast) return multicast;
    const Endpoint to =
        parse_endpoint("udp://" + state_.unicast_ip + ':' + std::to_string(state_.unicast_port));
    if (is_loopback(wiring_.own.ip) && !is_loopback(to.ip)) return std::nullopt;
    return Address{to.ip, to.port};
}

sonar3d::Timestamp Sonar::time_of(Time at) const {
    return unix_time(settings_.unix_start + state_.clock_error, at);
}

void Sonar::plan_imu(Time now) {
    const bool sends = state_.imu && settings_.release >= with_imu;
    next_batch_ = sends ? now + imu_samples * imu_period : Time::max();
}

void Sonar::send_imu_batch(Time now) {
    next_batch_ += imu_samples * imu_period;
    if (next_batch_ <= now) next_batch_ = now + imu_period;
    const std::uint32_t number = batches_++;
    const auto to = destination();
    if (!to) return;
    std::vector<ImuSample> samples;
    for (int i = imu_samples - 1; i >= 0; --i) samples.push_back(imu_.sample(time_of(now - i * imu_period)));
    const std::string url = "type.googleapis.com/" + settings_.package + ".ImuBatch";
    const sonar3d::OtherMessage batch{imu_batch(number, samples)};
    actions_.send.push_back({image_port, sonar3d::serialise({settings_.version, url, batch}), *to, {}});
}

Actions Sonar::woken(Time now) {
    if (now >= next_batch_) send_imu_batch(now);
    for (auto& [host, client] : clients_) {
        if (now < client.deadline) continue;
        const bool begun = client.reader.pending_bytes() > 0;
        client = {};
        if (begun) ++counters_.rejected;
        respond(begun ? http::response(408) : Bytes{}, host);
    }
    return take_actions();
}

/// Each answer says that it is the last one on its connection.
void Sonar::respond(Bytes response, Address to, Time when) {
    actions_.send.push_back({http_port, std::move(response), to, when, true});
}

Actions Sonar::take_actions() {
    Time wake = next_batch_;
    for (const auto& [host, client] : clients_) wake = std::min(wake, client.deadline);
    actions_.wake = wake;
    return std::exchange(actions_, {});
}

}  // namespace echoloop::sonar_3d_15
