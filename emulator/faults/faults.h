// The faults that a run is asked for, by scenario and live, and which of them are on. Knows no transport and
// no bytes.
#pragma once

#include <deque>
#include <functional>
#include <list>
#include <memory>

#include "emulator/contract/options.h"
#include "emulator/contract/ping_log.h"
#include "emulator/faults/dice.h"
#include "emulator/faults/labels.h"

namespace echoloop {

inline constexpr std::size_t most_faults = 1000;  ///< that a run is asked for at once

/// A fault that was asked for, and its share of chance.
struct AskedFault {
    int id = 0;
    Fault fault;
    Dice dice{0};
    std::uint64_t made = 0;       ///< events
    std::uint64_t swallowed = 0;  ///< messages that went nowhere while it was on
};

/// A parameter that is a whole number.
inline std::size_t whole(const AskedFault& asked, std::string_view name) {
    return static_cast<std::size_t>(integer(asked.fault.parameters, name));
}

/// Those of one device. Other devices' faults, and other kinds on this one, do not change its chances.
class DeviceFaults final : public PingLog {
  public:
    DeviceFaults(std::string name, std::uint64_t seed, FaultLabels& labels)
        : name_(std::move(name)), seed_(seed), labels_(labels) {}

    const std::string& name() const { return name_; }
    bool any() const { return !asked_.empty(); }
    std::list<AskedFault>& asked() { return asked_; }
    const std::list<AskedFault>& asked() const { return asked_; }

    /// Calls `make(AskedFault&)` for every one of that kind that is on.
    template <class Make>
    void each(FaultKind kind, Time now, Make make) {
        for (AskedFault& asked : asked_)
            if (asked.fault.kind == kind && asked.fault.on_until(now)) make(asked);
    }
    /// Of those that concern this port and direction.
    template <class Make>
    void each(FaultKind kind, const FaultPlace& place, Time now, Make make) {
        each(kind, now, [&](AskedFault& asked) {
            const bool here = asked.fault.port.empty() || asked.fault.port == place.port;
            if (here && asked.fault.at(place.direction)) make(asked);
        });
    }

    void add(int id, Fault fault);
    bool clear(int id);
    std::vector<std::string> on(Time now) const override;
    void record(Time now, const FaultPlace& place, const FaultEvent& event);

    void hears(std::uint64_t ping) override { heard_ping_ = ping; }
    void sends(std::uint64_t ping) override { sent_ping_ = ping; }
    /// Number of the ping that the device hears now; 0: none yet.
    std::uint64_t heard_ping() const { return heard_ping_; }
    /// Number of the ping that the message at hand belongs to; 0: none yet.
    std::uint64_t sent_ping() const { return sent_ping_; }
    /// `tell` is called when faults have come or gone.
    void on_change(std::function<void()> tell) { listeners_.push_back(std::move(tell)); }

  private:
    void tell_of_change() const {
        for (const auto& tell : listeners_) tell();
    }

    std::string name_;
    std::uint64_t seed_;
    FaultLabels& labels_;
    std::vector<std::function<void()>> listeners_;
    std::uint64_t heard_ping_ = 0, sent_ping_ = 0;
    std::list<AskedFault> asked_;
    std::array<std::uint64_t, fault_kinds> so_far_{};  ///< of each kind
};

/// Those of the whole run.
class Faults {
  public:
    /// `labels`: nullptr if none are written.
    Faults(
        std::uint64_t seed, const std::string& scenario, BackgroundFile* labels,
        FaultLabels::UnixTime unix_time = [] { return 0.0; })
        : seed_(seed), labels_(labels, seed, scenario, std::move(unix_time)) {}

    /// Makes the device's at the first call.
    DeviceFaults& of(const std::string& device);
    /// Returns the fault's number, from 1.
    int add(Fault fault);
    /// False if there is none of that number.
    bool clear(int id);
    /// Returns how many there were.
    std::size_t clear_all();
    std::size_t count() const;
    const std::deque<DeviceFaults>& devices() const { return devices_; }
    const FaultLabels& labels() const { return labels_; }
    /// Before the first fault: `watch` sees each, and outlives this.
    void show(Watch& watch) { labels_.show(watch); }

  private:
    std::uint64_t seed_;
    FaultLabels labels_;
    std::deque<DeviceFaults> devices_;  // they never move
    int last_id_ = 0;
};

}  // namespace echoloop
