// The words of levels in what a model sends, of a scene or of water alone: all arrays of whole numbers of 8
// or 16 bits in its messages. Which messages there are, the scenarios in config/ and the cases of `echoloop
// bench --wire` say. Draws nothing; judges nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "emulator/contract/random_key.h"
#include "emulator/scenario/scene.h"
#include "protocols/inspect.h"
#include "render/renderer.h"
#include "tests/emulator/devices/driver.h"
#include "tools/echoloop/bench/wire.h"

namespace echoloop::test {

using bench::WireCase;

/// One kind of words of a model, all pings together.
struct Words {
    std::vector<double> values;
    std::size_t bytes = 1;  ///< of a word
    std::size_t changed = 0;

    double lowest() const { return is_signed() ? -std::ldexp(1, static_cast<int>(8 * bytes) - 1) : 0; }
    double highest() const { return lowest() + std::ldexp(1, static_cast<int>(8 * bytes)) - 1; }
    bool is_signed() const { return *std::ranges::min_element(values) < 0; }
    double part(double value) const {
        return static_cast<double>(std::ranges::count(values, value)) / static_cast<double>(values.size());
    }
    /// The value that a part of the words does not exceed. The few bytes that stand before samples in some
    /// messages are no words, so that neither end is taken at its face value.
    double at_most(double share) const {
        std::vector<double> sorted = values;
        const auto nth = sorted.begin() +
                         static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1) + 0.5);
        std::ranges::nth_element(sorted, nth);
        return *nth;
    }
    /// Of what the scale could hold: eight bits and words with a sign by their values, wide ones in dB above
    /// one step.
    double used() const {
        const double low = at_most(0.002), high = at_most(0.998);
        if (bytes == 1 || is_signed()) return (high - low) / (highest() - lowest());
        return std::log(std::max(high, 1.0)) / std::log(highest());
    }
};
using Report = std::map<std::string, Words>;  ///< by message and field

/// Not where a step of 16 bits is some dB: no echo could use a third of their thousands.
inline bool is_word(const inspect::Field& field) {
    constexpr std::size_t least = 32;
    const bool wide_db = field.unit.ends_with("dB") && field.size == 2 * field.numbers.size();
    return !wide_db && field.numbers.size() >= least && std::ranges::all_of(field.numbers, [](double n) {
        return n == std::floor(n) && std::abs(n) < 65536;
    });
}

inline std::vector<inspect::Field> word_fields(const inspect::Family& family, const std::vector<Send>& sent) {
    std::vector<inspect::Field> found;
    Bytes held;
    std::map<std::size_t, Bytes> streams;  // by port
    const std::vector<inspect::Field> no_fields;
    const auto add = [&](ByteView bytes) {
        for (const auto& message : family.decode(bytes))
            for (inspect::Field field : message.name.ends_with(" part") ? no_fields : message.fields)
                if (is_word(field)) {
                    field.name = message.name + "." + field.name;
                    const std::size_t from = field.name.find('['), to = field.name.find(']');
                    if (to != field.name.npos) field.name.erase(from, to - from + 1);  // of each beam
                    found.push_back(std::move(field));
                }
    };
    const auto is_whole = [&](ByteView bytes) {
        return std::ranges::none_of(family.decode(bytes), [](const auto& m) { return m.name.empty(); });
    };
    for (const Send& send : sent) {
        if (family.join != nullptr && family.join(held, send.bytes)) {
            add(held);
        } else if (family.framing == inspect::Framing::datagram || is_whole(send.bytes)) {
            add(send.bytes);
        } else {
            Bytes& stream = streams[send.port];
            stream.insert(stream.end(), send.bytes.begin(), send.bytes.end());
        }
    }
    for (const auto& [port, bytes] : streams) add(bytes);
    return found;
}

/// A device in its scene, driven by what its model or the bench says to it. `gain`: dB on all that it hears.
class InScene {
  public:
    InScene(const Scenario& scenario, const ScenarioDevice& device, Renderer& renderer, const WireCase* words,
            double gain)
        : scenario_(scenario),
          device_(device),
          renderer_(renderer),
          words_(words),
          factor_(static_cast<float>(std::pow(10, gain / 10))),
          bench_(made(device, words)) {
        const auto ports = bench_.device().ports();
        for (std::size_t port = 0; port < ports.size(); ++port)
            if (ports[port].kind == Port::Kind::stream) bench_.connect(port, {0x7F000001, 50000});
    }

    /// What it sends of so many pings. False if it does not ping.
    bool run(int pings, std::vector<Send>& sent) {
        for (int done = 0; done < pings; ++done) {
            if (!await_ping()) return false;
            Shot shot = bench_.ping->shot;
            shot.random_key = random_key(scenario_.seed, device_.name);
            if (device_.model->turn_steps > 1) shot.pan = 2 * std::numbers::pi * done / pings;  // all round
            Echogram echogram = renderer_.render(shot, scenario_.world_from_body * device_.body_from_sonar);
            for (float& value : echogram.values) value *= factor_;
            echogram.noise_power *= factor_;
            bench_.hear(echogram);
        }
        bench_.run_to(bench_.now + std::chrono::milliseconds(30));
        sent = bench_.sent();
        return true;
    }

  private:
    static std::unique_ptr<Device> made(const ScenarioDevice& device, const WireCase* words) {
        DeviceConfig config = device.config;
        if (words != nullptr)
            for (const auto& [name, value] : words->options)
                if (name != "range") config.options.at(name) = value;  // the scene's own
        return device.model->make(config);
    }
    void ask() {
        if (words_ != nullptr)
            for (const auto& word : words_->words) bench_.say(word.bytes, word.port, {0x7F000001, 50000});
        if (words_ == nullptr && device_.model->requests != nullptr)
            for (const Bytes& request : device_.model->requests(device_.config, 2, false))
                if (!request.empty()) bench_.say(request, 0, {0x7F000001, 50000});
    }
    bool await_ping() {
        constexpr int most = 5000, until_asked = 100;
        for (int woken = 0; !bench_.ping && woken < most; ++woken) {
            if (woken % until_asked == 0) ask();
            if (bench_.ping) break;
            if (bench_.wake == Time::max()) return false;
            bench_.run_to(std::max(bench_.now, bench_.wake));
        }
        return bench_.ping.has_value();
    }

    const Scenario& scenario_;
    const ScenarioDevice& device_;
    Renderer& renderer_;
    const WireCase* words_;
    float factor_;
    Bench bench_;
};

/// Takes what the bench says to a device's model, one kind of words at a time; null: what the model itself
/// requests. `take(words)`.
template <class Take>
void each_way_to_ask(const ScenarioDevice& device, const Take& take) {
    static const auto cases = bench::wire_cases();
    bool known = false;
    for (const WireCase& one : cases)
        if (one.model == device.model->name && (device.model->requests == nullptr || !one.words.empty()))
            take(&one), known = true;
    if (!known) take(static_cast<const WireCase*>(nullptr));
}

/// Scenarios that show something else than their sonars: faults, load, movement, a clock from outside, waters
/// and rooms that hide what is in them.
inline bool shows_sonars(const std::string& name) {
    static const std::set<std::string> others{"basin",  "busy",    "deep-water", "faults", "harbour",
                                              "moving", "stepped", "survey",     "sweep"};
    return !others.contains(name);
}

}  // namespace echoloop::test
