// .jsf: messages back to back as they came, behind one that says what the system is.
#include "protocols/edgetech/codec.h"
#include "tools/echoloop/convert/recording.h"

namespace echoloop::convert {
namespace {

/// Files hold what a sonar measures, not what it answers to a host.
bool is_measured(const edgetech::Header& header) {
    using edgetech::Type;
    switch (header.type) {
        case Type::sonar_data:
        case Type::old_side_scan:
        case Type::nmea_text:
        case Type::pitch_roll:
        case Type::pressure:
        case Type::doppler_log:
        case Type::situation:
        case Type::situation_2:
            return true;
        default:
            return false;
    }
}

Bytes system_information() {
    constexpr std::int32_t series_2xxx = 2;
    const std::string_view text = "echoloop";
    edgetech::SystemInformation system;
    system.system = series_2xxx;
    system.software_version = 1;
    system.text.assign(text.begin(), text.end());
    system.text_size = static_cast<std::uint32_t>(text.size());
    return edgetech::encode({{.type = edgetech::Type::system_information}, system});
}

class Jsf final : public Recording {
  public:
    void begin(std::ostream& out) override { put(out, system_information()); }

    void add(const Heard& heard, std::ostream& out) override {
        const auto header = edgetech::plausible_header(heard.bytes);
        if (!header || !is_measured(*header)) return;
        put(out, heard.bytes);
        ++count_;
    }
};

}  // namespace

std::unique_ptr<Recording> make_jsf() { return std::make_unique<Jsf>(); }

}  // namespace echoloop::convert
