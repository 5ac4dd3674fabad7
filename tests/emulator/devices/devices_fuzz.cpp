// Any bytes at any time to every model: it must not crash, hang, send where no port is, or ask for a ping
// that cannot be rendered. ECHOLOOP_MODEL=NAME tries one model only, ECHOLOOP_MODEL=list names them. The
// input is {model, options, echo}, then records of {port, pause in 10 ms, length, bytes}; a pause of 255 is
// another driver at the same port, of 254 one more or one less where there are several.
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "tests/emulator/devices/driver.h"
#include "tests/protocols/mutator.h"

using namespace echoloop;

namespace {

void require(bool good) {
    if (!good) std::abort();
}

const Model* wanted_model() {
    const char* name = std::getenv("ECHOLOOP_MODEL");
    if (name == nullptr) return nullptr;
    if (const Model* model = find_model(name)) return model;
    for (const Model& model : models()) std::printf("%s\n", model.name.c_str());
    std::fflush(stdout);
    std::_Exit(std::string_view(name) == "list" ? 0 : 64);  // exit() would count as a fault
}

void check(const Shot& shot) {
    require(shot.bins > 0 && shot.bins * shot.bearings.size() <= (std::size_t{16} << 20));
    require(std::isfinite(shot.bin_interval) && shot.bin_interval > 0);
    require(static_cast<double>(shot.bins) * shot.bin_interval <= 60);
    require(std::isfinite(shot.pan) && std::isfinite(shot.tilt) && std::isfinite(shot.source_level));
    require(shot.beam_width > 0 && shot.fan_height > 0 && shot.frequency > 0 && shot.pulse_length >= 0);
    for (std::size_t n = 1; n < shot.bearings.size(); ++n) require(shot.bearings[n] > shot.bearings[n - 1]);
}

/// Switches and words other than the defaults, drawn by `seed`; none for 0.
Options some_options(const Model& model, unsigned seed) {
    Options changes;
    std::mt19937 random(seed);
    for (const Option& option : model.options) {
        if (seed == 0 || random() % 4 != 0) continue;
        if (!option.choices.empty()) changes[option.name] = option.choices[random() % option.choices.size()];
        if (const bool* value = std::get_if<bool>(&option.default_value)) changes[option.name] = !*value;
    }
    return changes;
}

/// Reading a profile takes longer than most inputs, so it is read once.
DeviceConfig config_of(const Model& model) {
    static std::map<std::string, DeviceConfig> read;
    if (const auto found = read.find(model.name); found != read.end()) return found->second;
    DeviceConfig config = test::make_config(model);
    if (model.family == "r2sonic")  // with a SIM and all that may be wired to it
        for (const char* more : {"udp-listen://127.0.0.1:65300", "pty:/tmp/echoloop-motion",
                                 "udp-listen://127.0.0.1:5002", "pty:/tmp/echoloop-svp"})
            config.endpoints.push_back(parse_endpoint(more));
    return read.emplace(model.name, config).first->second;
}

/// A device on a bench that hears a few pings only: one that pings by itself must not eat the time.
class ShortBench {
  public:
    ShortBench(std::unique_ptr<Device> device, std::uint8_t echo)
        : bench_(std::move(device)), ports_(bench_.device().ports()) {
        bench_.echo_bin = echo * 8U;
        bench_.echo_power = echo % 4 == 0 ? 0.0F : std::pow(10.0F, static_cast<float>(echo % 32));
        require(!ports_.empty());
    }

    /// Lets time pass until `effort` is spent on echoes, or all that there is for the input.
    void run_for(Time time, std::size_t effort) {
        const Time end = bench_.now + time;
        for (const std::size_t enough = spent_ + effort; spent_ < std::min(enough, most_effort);) {
            bench_.wake = std::max(bench_.wake, bench_.now);
            const Time due = bench_.ping ? bench_.ping->due : Time::max();
            const Time next = std::max(bench_.now, std::min(bench_.wake, due));
            if (next > end) {
                bench_.now = end;
                return;
            }
            if (due <= next) spent_ += 2000 + bench_.ping->shot.bearings.size() * bench_.ping->shot.bins;
            bench_.run_to(next);
            take();
        }
    }

    /// The number chooses the port, and who speaks there.
    void say(std::size_t number, ByteView bytes) {
        const std::size_t port = number % ports_.size();
        if (ports_[port].drivers > 1 && !connected_.contains({port, peer(number)})) come_or_go(number);
        bench_.say(bytes, port, peer(number));
        take();
    }
    void reconnect(std::size_t number) {
        const std::size_t port = number % ports_.size();
        if (ports_[port].kind == Port::Kind::stream && ports_[port].drivers == 1)
            bench_.device().reconnected(port);
    }
    void come_or_go(std::size_t number) {
        const std::size_t port = number % ports_.size();
        if (ports_[port].drivers == 1) return;
        if (connected_.insert({port, peer(number)}).second) {
            bench_.connect(port, peer(number));
        } else {
            bench_.disconnect(port, peer(number));
            connected_.erase({port, peer(number)});
        }
        take();
    }

  private:
    static constexpr std::size_t most_effort = 300000;  // bins

    Address peer(std::size_t number) const {
        const std::size_t port = number % ports_.size(), which = number / ports_.size() % 3;
        const bool several = ports_[port].drivers > 1;
        return {0x7F000001, static_cast<std::uint16_t>(40000 + (several ? which : 0))};
    }
    void take() {
        if (bench_.ping) check(bench_.ping->shot);
        for (const Send& send : bench_.sent())
            require(send.port < ports_.size() && (!send.bytes.empty() || send.hang_up));
        bench_.shots.clear();
    }

    test::Bench bench_;
    std::vector<Port> ports_;
    std::set<std::pair<std::size_t, Address>> connected_;  ///< on ports of several drivers
    std::size_t spent_ = 0;
};

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
    static const Model* const only = wanted_model();
    const Model& model = only != nullptr ? *only : models()[size == 0 ? 0 : data[0] % models().size()];
    const fuzz::Shape shape{model.family, 3};
    const Bytes out = fuzz::mutated_records({data, size}, most, seed, shape, 2, LLVMFuzzerMutate);
    std::copy_n(out.begin(), std::min(out.size(), most), data);
    return std::min(out.size(), most);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Model* const only = wanted_model();
    ByteView input(data, size);
    if (input.size() < 3) return 0;
    const Model& model = only != nullptr ? *only : models()[input[0] % models().size()];
    std::unique_ptr<Device> device;
    try {
        DeviceConfig config = config_of(model);
        for (auto& [name, value] : some_options(model, input[1])) config.options.at(name) = value;
        device = model.make(config);
    } catch (const std::invalid_argument&) {
        return 0;  // options that do not fit together are refused before a run
    }
    ShortBench bench(std::move(device), input[2]);
    input = input.subspan(3);
    bench.run_for(std::chrono::seconds(4), 50000);
    for (int records = 0; input.size() >= 3 && records < 64; ++records) {
        const std::size_t port = input[0], length = std::min<std::size_t>(input[2], input.size() - 3);
        bench.run_for(input[1] * std::chrono::milliseconds(10), 100000);
        if (input[1] == 255) bench.reconnect(port);
        if (input[1] == 254) bench.come_or_go(port);
        bench.say(port, input.subspan(3, length));
        input = input.subspan(3 + length);
    }
    bench.run_for(std::chrono::seconds(2), 300000);
    return 0;
}
