// The record of every fault that was made: counts for the run's end, and a line of JSON each in a label file.
// Makes no fault.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "emulator/capture/background_file.h"
#include "emulator/capture/watch.h"
#include "emulator/scenario/fault.h"

namespace echoloop {

/// One thing that went wrong.
struct FaultEvent {
    FaultKind kind = FaultKind::loss;
    int id = 0;                              ///< of the fault that was asked for
    std::optional<std::uint64_t> ping{};     ///< number of the device's ping, from 1
    std::optional<std::uint64_t> message{};  ///< number of the message on its port, from 0
    std::uint64_t offset = 0;                ///< B in the port's stream; before it is sent: in its message
    std::size_t length = 0;                  ///< B that it is about
    std::vector<std::pair<std::string, std::variant<std::int64_t, double, std::string>>> details{};
    bool is_end = false;  ///< of what has been told of already
};

/// Where on which wire.
struct FaultPlace {
    std::string device;
    std::string port{};  ///< "": the whole device
    Towards direction = Towards::to_driver;
};

/// What was made on one device, by kind.
using FaultCounts = std::array<std::uint64_t, fault_kinds>;

class FaultLabels {
  public:
    /// s since 1970.
    using UnixTime = std::function<double()>;
    /// `file`: nullptr for counts alone; outlives this. Its first line says what it is.
    FaultLabels(BackgroundFile* file, std::uint64_t seed, const std::string& scenario, UnixTime unix_time);

    /// From now on `watch` sees each fault, too; it outlives this.
    void show(Watch& watch) { watch_ = &watch; }
    void add(Time now, const FaultPlace& place, const FaultEvent& event);
    const std::map<std::string, FaultCounts>& counts() const { return counts_; }

  private:
    BackgroundFile* file_;
    Watch* watch_ = nullptr;
    UnixTime unix_time_;
    std::map<std::string, FaultCounts> counts_;
};

/// What a recording says of the bytes that a fault has touched: "bit_flips: byte 17, bit 3".
std::string comment_of(const FaultEvent& event);

}  // namespace echoloop
