#include "tools/echoloop/asking.h"

#include "emulator/contract/options.h"
#include "protocols/imagenex/codec.h"
#include "protocols/oculus/codec.h"
#include "protocols/ping/codec.h"
#include "protocols/seanet/codec.h"

namespace echoloop::cli {
namespace {

Bytes ask_imagenex(const Options& options, bool turns) {
    imagenex::SwitchCommand command;
    command.head_id = static_cast<std::uint8_t>(integer(options, "head_id"));
    command.range = 10;
    command.mode = imagenex::mode::all;
    command.sector_width = 120;
    command.step_size = turns ? 1 : 0;
    command.pulse_length = 10;
    command.data_points = 25;
    command.data_bits = 8;
    return imagenex::encode(imagenex::Message(command));
}

/// 200 bins of 25 mm, a step of 0.9 deg at 250 us for each 1/16 gradian.
Bytes configure_seanet(bool turns) {
    seanet::HeadCommand command;
    seanet::HeadParameters& p = command.parameters;
    p.hd_ctrl = seanet::hd_ctrl::adc8on | seanet::hd_ctrl::cont | seanet::hd_ctrl::scanright |
                seanet::hd_ctrl::raw | seanet::hd_ctrl::hasmot | seanet::hd_ctrl::reply_asl;
    p.hd_type = 0x11;
    p.range_scale = 50;
    p.ad_span = 81;
    p.motor_time = 25;
    p.step_size = turns ? 16 : 0;
    p.ad_interval = 52;
    p.bins = 200;
    p.max_ad_buffer = 1000;
    return seanet::encode(seanet::Message(command));
}

/// 20 ms for a ping, 15 m; a pass of one, or of two 0.9 deg apart at 250 us for each 1/16 gradian.
Bytes configure_profiler(bool turns) {
    seanet::ProfilerCommand command;
    seanet::ProfilerParameters& p = command.parameters;
    p.hd_ctrl = seanet::profiler_ctrl::hasmot | seanet::profiler_ctrl::scanright;
    p.tx_pulse = 62;
    p.range_scale = 150;
    p.left_limit = 3200;
    p.step_size = turns ? 16 : 0;
    p.right_limit = 3200 + 16;
    p.motor_time = 25;
    p.scan_time = 200;
    return seanet::encode(seanet::Message(command));
}

}  // namespace

std::vector<Bytes> requests_of(const ScenarioDevice& device, bool turns) {
    const std::string& model = device.model->name;
    const auto ping360 = [](std::uint16_t angle) {
        return ping::encode(ping::Message(ping::Transducer{1, 0, angle, 11, 88, 750, 1200, 1, 0}));
    };
    if (model == "ping360") return {ping360(0), ping360(turns ? 1 : 0)};
    if (model == "ping1d") {
        constexpr std::uint16_t profile = 1300;
        return {ping::encode(ping::Message(ping::GeneralRequest{profile}))};
    }
    if (model.starts_with("imagenex-8"))
        return std::vector<Bytes>(2, ask_imagenex(device.config.options, turns));
    if (model.starts_with("oculus-"))
        return {oculus::encode(oculus::Message(oculus::Fire{.range = 10, .gain = 50}))};
    if (model == "tritech-micron" || model == "tritech-seaking") {
        const Bytes ask = seanet::encode(seanet::Message(seanet::SendData{}));
        return {configure_seanet(turns), ask, ask};
    }
    if (model == "tritech-profiler") {
        std::vector<Bytes> words{
            configure_profiler(turns),
            seanet::encode(seanet::Message(seanet::SendData{}), {seanet::nodes::profiler})};
        if (turns) words.emplace_back();  // the second ping of a pass comes unasked
        return words;
    }
    return {};
}

}  // namespace echoloop::cli
