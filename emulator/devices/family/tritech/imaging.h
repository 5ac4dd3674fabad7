// An imaging head behind its SeaNet serial line: Micron DST, or SeaKing, SeaPrince and MiniKing. A pure state
// machine.
#pragma once

#include <array>
#include <optional>

#include "emulator/devices/family/tritech/head.h"
#include "emulator/devices/family/tritech/imaging_settings.h"

namespace echoloop::tritech {

class Imaging final : public Head {
  public:
    explicit Imaging(const ImagingSettings& settings);
    Actions heard(const Echogram& echogram, Time now) override;

  private:
    /// What a command says of one of the two channels.
    struct Setting {
        Channel channel;
        std::uint8_t ad_span = 0, ad_low = 0, gain = 0;
    };

    bool configure(const seanet::Message& message, Time now) override;
    void begin(Time now) override;
    void forget() override;
    std::uint16_t position() const override { return scan_.position(); }
    Time side_work_due() const override;
    void begin_side_work(Time now) override;

    bool take_parameters(const seanet::HeadParameters& parameters, const seanet::V3B* v3b, Time now);
    void take_gains(const seanet::V3B& v3b);
    void turn_round();
    const Setting& setting() const;
    bool has(std::uint16_t bit) const { return (parameters_->hd_ctrl & bit) != 0; }
    std::size_t reply_bytes(const Shot& shot) const;
    Time ping_time(const Shot& shot) const;
    std::uint8_t head_status() const;
    seanet::HeadData head_data(const Echogram& echogram) const;
    void sounded(const Echogram& echogram, Time now);
    std::size_t send_aux();

    ImagingSettings settings_;
    Scan scan_;
    std::optional<seanet::HeadParameters> parameters_;
    std::array<Setting, 2> settings_of_;  ///< of the channels
    Tuning tuning_;                       ///< of the line under way
    int lines_ = 0;                       ///< since the parameters came
    bool aux_under_way_ = false;
    Time next_aux_{};
    std::string aux_text_;  ///< waits for the line that it is appended to
};

}  // namespace echoloop::tritech
