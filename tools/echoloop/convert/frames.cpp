// .svlog of Cerulean and .bin of Ping Viewer: the frames of Blue Robotics' protocol that a sonar sent.
#include <cmath>
#include <cstdio>
#include <ctime>

#include "tools/echoloop/convert/recording.h"

namespace echoloop::convert {
namespace {

std::string iso_time(double seconds) {
    const auto whole = static_cast<std::time_t>(seconds);
    std::tm utc{};
    char text[40] = "";
    ::gmtime_r(&whole, &utc);
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

/// Frames back to back behind one of JSON about the session.
class SvLog final : public Recording {
  public:
    void look(const Heard& heard) override {
        if (!begun_) time_ = heard.time;
        begun_ = true;
    }

    void begin(std::ostream& out) override {
        const std::string json =
            "{\"session_id\": 1, \"session_uptime\": 0.0, \"session_devices\": [], "
            "\"is_recording\": true, \"process_path\": \"echoloop\", \"timestamp\": \"" +
            iso_time(time_) + "\", \"timestamp_timezone_offset\": 0}";
        constexpr std::uint8_t json_wrapper = 10;
        Bytes frame{'B',
                    'R',
                    static_cast<std::uint8_t>(json.size()),
                    static_cast<std::uint8_t>(json.size() >> 8),
                    json_wrapper,
                    0,
                    0,
                    0};
        frame.insert(frame.end(), json.begin(), json.end());
        std::uint16_t sum = 0;
        for (const std::uint8_t byte : frame) sum = static_cast<std::uint16_t>(sum + byte);
        frame.insert(frame.end(), {static_cast<std::uint8_t>(sum), static_cast<std::uint8_t>(sum >> 8)});
        put(out, frame);
    }

    void add(const Heard& heard, std::ostream& out) override {
        if (heard.name.empty() || heard.name == "JsonWrapper") return;
        put(out, heard.bytes);
        ++count_;
    }

  private:
    double time_ = 0;
    bool begun_ = false;
};

/// Big-endian, texts as a length in bytes and UTF-16.
class PingViewerLog final : public Recording {
  public:
    void look(const Heard& heard) override {
        if (!begun_) time_ = heard.time;
        begun_ = true;
        is_ping360_ |= heard.name == "DeviceData" || heard.name == "AutoDeviceData";
    }

    void begin(std::ostream& out) override {
        Bytes head;
        text(head, "PingViewer sensor log file");
        number(head, 1);
        for (const char* about : {"echoloop", "", "", "linux", ""}) text(head, about);
        number(head, 1);
        number(head, is_ping360_ ? 2 : 1);
        put(out, head);
    }

    void add(const Heard& heard, std::ostream& out) override {
        if (heard.name.empty()) return;
        Bytes record;
        const auto ms = static_cast<long>(std::lround((heard.time - time_) * 1000));
        char clock[32];
        std::snprintf(clock, sizeof clock, "%02ld:%02ld:%02ld.%03ld", ms / 3600000 % 100, ms / 60000 % 60,
                      ms / 1000 % 60, ms % 1000);
        text(record, clock);
        number(record, static_cast<std::uint32_t>(heard.bytes.size()));
        record.insert(record.end(), heard.bytes.begin(), heard.bytes.end());
        put(out, record);
        ++count_;
    }

  private:
    static void number(Bytes& out, std::uint32_t value) {
        for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(value >> shift));
    }
    static void text(Bytes& out, std::string_view ascii) {
        number(out, static_cast<std::uint32_t>(2 * ascii.size()));
        for (const char c : ascii) out.insert(out.end(), {0, static_cast<std::uint8_t>(c)});
    }

    double time_ = 0;
    bool begun_ = false, is_ping360_ = false;
};

}  // namespace

std::unique_ptr<Recording> make_svlog() { return std::make_unique<SvLog>(); }
std::unique_ptr<Recording> make_ping_viewer_log() { return std::make_unique<PingViewerLog>(); }

}  // namespace echoloop::convert
