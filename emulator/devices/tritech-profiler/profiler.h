// A SeaKing profiler (node 20) behind its SeaNet serial line: a reply is the echo times of a whole pass. A
// pure state machine.
#pragma once

#include <array>
#include <optional>

#include "emulator/contract/model.h"
#include "emulator/devices/family/tritech/head.h"
#include "emulator/devices/tritech-profiler/settings.h"

namespace echoloop::profiler {

class Profiler final : public tritech::Head {
  public:
    explicit Profiler(const Settings& settings);
    Actions heard(const Echogram& echogram, Time now) override;

  private:
    /// What a command says of one of the two channels, in its own units.
    struct Setting {
        tritech::Channel channel;
        std::uint8_t threshold = 0, filt_gain = 0, agc_max = 0, agc_set_point = 0;
    };

    bool configure(const seanet::Message& message, Time now) override;
    void begin(Time now) override;
    void forget() override { parameters_.reset(); }
    std::uint16_t position() const override;

    bool take_parameters(const seanet::ProfilerCommand& command, Time now);
    void take_gains(const seanet::ProfilerGains& gains);
    bool has(std::uint16_t bit) const { return (parameters_->hd_ctrl & bit) != 0; }
    const Setting& setting() const { return settings_of_[has(seanet::profiler_ctrl::chan2) ? 1 : 0]; }
    double most_gain() const;
    void adapt_gain(double peak);
    void transmit(Time now);
    seanet::ProfilerData pass_data();

    Settings settings_;
    std::optional<seanet::ProfilerParameters> parameters_;
    std::array<Setting, 2> settings_of_;  ///< of the channels
    tritech::Tuning tuning_;
    double gain_ = 0;  ///< dB, of the next ping
    Pass pass_;
    std::vector<std::uint16_t> echo_times_;  ///< us, of the pass under way
};

/// The row of the table of models.
Model model();

}  // namespace echoloop::profiler
