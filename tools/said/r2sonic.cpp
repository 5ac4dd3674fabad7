// R2Sonic: soundings are one datagram; all else comes in parts, after a head.
#include <algorithm>
#include <cmath>
#include <utility>

#include "protocols/r2sonic/beams.h"
#include "protocols/r2sonic/codec.h"
#include "tools/said/fields.h"

namespace echoloop::said {
namespace {

namespace r2 = r2sonic;

class R2Sonic final : public Maker {
  public:
    std::optional<Picture> take(const inspect::Message& message, wire::ByteView bytes, bool sent) override {
        also_.reset();
        if (!sent) return std::nullopt;
        const auto packet = r2::parse(bytes);
        if (!packet) return std::nullopt;
        return std::visit(
            [&](const auto& p) -> std::optional<Picture> {
                if constexpr (requires { add(p, message.name); }) return add(p, message.name);
                return std::nullopt;
            },
            *packet);
    }

    std::optional<Picture> also() override { return std::exchange(also_, std::nullopt); }

    void skipped(std::string_view message) override {
        if (message == "SNI0") snippets_ = {};
    }

  private:
    /// What comes in parts, and how much of it is there.
    struct Parts {
        Picture picture{};
        r2::H0 head{};
        std::uint32_t ping = 0;
        std::size_t filled = 0;  ///< levels; 0 before the first part
    };

    static std::optional<Picture> add(const r2::Bth0& packet, const std::string& name) {
        Picture picture;
        picture.name = name;
        picture.down = true;
        picture.bearings = r2::angles(packet);
        for (const double time : r2::two_way_times(packet.r0))
            picture.ranges.push_back(range_or_none(time * packet.h0.sound_speed / 2));
        return checked(std::move(picture));
    }

    std::optional<Picture> add(const r2::Aid0Head& packet, const std::string&) {
        return begin(image_, "AID0", "counts", packet.h0, packet.a1);
    }
    std::optional<Picture> add(const r2::Wcd0Head& packet, const std::string&) {
        return begin(water_, "WCD0", decibels_of_counts, packet.h0, packet.a1);
    }
    std::optional<Picture> add(const r2::Aid0Data& packet, const std::string&) {
        const r2::M0& m = packet.m0;
        if (!fits(image_, m.ping_number, m.total_beams, m.total_bins, m.total_samples)) return std::nullopt;
        return fill(image_, m.first_beam, m.beams, m.first_bin, m.bins,
                    [&](std::size_t i) { return static_cast<float>(m.data[i]); });
    }
    std::optional<Picture> add(const r2::Wcd0Data& packet, const std::string&) {
        return std::visit(
            [&](const auto& m) -> std::optional<Picture> {
                if (!fits(water_, m.ping_number, m.total_beams, m.total_samples, m.total_samples))
                    return std::nullopt;
                return fill(water_, m.first_beam, m.beams, m.first_sample, m.samples, [&](std::size_t i) {
                    if constexpr (requires { m.data[i].magnitude; })
                        return decibels(m.data[i].magnitude);
                    else
                        return decibels(m.data[i]);
                });
            },
            packet.samples);
    }

    /// Port and starboard of a side-scan.
    std::optional<Picture> add(const r2::Tpx0& packet, const std::string&) {
        if (packet.h0) sides_.head = packet.h0->settings;
        return std::visit(
            [&](const auto& d) -> std::optional<Picture> {
                if (sides_.ping != d.ping_number || sides_.filled == 0) {
                    sides_.picture = {};
                    sides_.picture.name = "TPX0";
                    sides_.picture.unit = decibels_of_counts;
                    sides_.picture.waterfall = true;
                    sides_.picture.bearings = {-1, 1};  // sides, whatever their angles
                }
                if (!fits(sides_, d.ping_number, 2, d.total_samples, d.total_samples)) return std::nullopt;
                const std::size_t count = std::min<std::size_t>(d.samples, d.data.size());
                return fill(sides_, 0, 2, d.first_sample, count, [&](std::size_t i) {
                    return decibels(i < count ? d.data[i].port : d.data[i - count].starboard);
                });
            },
            packet.samples);
    }

    /// The snippets of one ping.
    struct Snippets {
        r2::H0 head{};
        std::vector<r2::S1> all{};
        std::size_t samples = 0;
    };

    /// A point without a bottom has no snippet, so what is there is a picture when the last point has come,
    /// or the next ping.
    std::optional<Picture> add(const r2::Sni0& packet, const std::string&) {
        std::optional<Picture> before;
        if (packet.h0) {
            before = whole(std::exchange(snippets_, {}));
            snippets_.head = packet.h0->settings;
        }
        keep(packet.s1);
        for (const r2::S1& snippet : packet.others) keep(snippet);
        const std::size_t points = snippets_.head.points;
        if (snippets_.all.empty() || snippets_.all.back().snippet + std::size_t{1} < points) return before;
        auto last = whole(std::exchange(snippets_, {}));
        if (!before) return last;
        also_ = std::move(last);
        return before;
    }

    void keep(const r2::S1& snippet) {
        constexpr std::size_t most = 4096, most_samples = std::size_t{8} << 20;
        const bool fits = snippets_.all.size() < most && snippets_.samples < most_samples;
        if (!fits || snippet.ping_number != snippets_.head.ping_number || !std::isfinite(snippet.angle))
            return;
        snippets_.samples += snippet.magnitude.size();
        snippets_.all.push_back(snippet);
    }

    static std::optional<Picture> whole(const Snippets& ping) {
        if (!(ping.head.rx_sample_rate > 0)) return std::nullopt;
        std::vector<Strip> strips;
        for (const r2::S1& s : ping.all) {
            strips.push_back({double(s.angle), s.first_sample, {}});
            for (std::size_t i = 0; i < s.magnitude.size(); ++i)
                strips.back().levels.push_back(decibels(s.magnitude[i] * scale_of(s, i)));
        }
        Picture picture;
        picture.name = "SNI0";
        picture.unit = decibels_of_counts;
        picture.down = true;
        return picture_of(std::move(strips), std::move(picture),
                          double(ping.head.sound_speed) / 2 / double(ping.head.rx_sample_rate));
    }

    /// Linear from the first sample to the last; 1 where the message leaves it at 0.
    static double scale_of(const r2::S1& s, std::size_t sample) {
        if (s.scale_first == 0 && s.scale_last == 0) return 1;
        const double along = s.magnitude.size() > 1 ? double(sample) / double(s.magnitude.size() - 1) : 0;
        return double(s.scale_first) + (double(s.scale_last) - double(s.scale_first)) * along;
    }

    static std::optional<Picture> begin(Parts& parts, const char* name, const char* unit, const r2::H0& head,
                                        const r2::A1& angles) {
        parts = {};
        parts.head = head;
        parts.ping = head.ping_number;
        parts.picture.name = name;
        parts.picture.unit = unit;
        parts.picture.down = true;
        parts.picture.bearings.assign(angles.angle.begin(), angles.angle.end());
        return std::nullopt;
    }

    /// Makes room at the first part. `samples`: of the range, at the head's rate.
    static bool fits(Parts& parts, std::uint32_t ping, std::size_t beams, std::size_t bins,
                     std::size_t samples) {
        constexpr std::size_t most = std::size_t{32} << 20;
        Picture& picture = parts.picture;
        if (beams == 0 || bins == 0 || bins > most / beams || !(parts.head.rx_sample_rate > 0)) return false;
        if (parts.filled > 0 && parts.ping == ping) return picture.bins == bins;
        if (picture.bearings.size() > beams || picture.bearings.empty()) return false;
        if (parts.ping != ping && picture.name != "TPX0") return false;
        parts.ping = ping;
        parts.filled = 0;
        picture.bins = bins;
        picture.bin_size = double(parts.head.sound_speed) / 2 / double(parts.head.rx_sample_rate) *
                           double(samples) / double(bins);
        picture.levels.assign(picture.bearings.size() * bins, std::numeric_limits<float>::quiet_NaN());
        return true;
    }

    /// Given out when the last level is there; of lost parts the rest is nothing.
    template <class Level>
    static std::optional<Picture> fill(Parts& parts, std::size_t first_beam, std::size_t beams,
                                       std::size_t first_bin, std::size_t bins, Level level) {
        Picture& picture = parts.picture;
        for (std::size_t beam = 0; beam < beams; ++beam)
            for (std::size_t bin = 0; bin < bins; ++bin) {
                if (first_beam + beam >= picture.bearings.size() || first_bin + bin >= picture.bins) continue;
                picture.levels[(first_beam + beam) * picture.bins + first_bin + bin] =
                    level(beam * bins + bin);
                ++parts.filled;
            }
        const bool last = first_bin + bins >= picture.bins && first_beam + beams >= picture.bearings.size();
        if (!last && parts.filled < picture.levels.size()) return std::nullopt;
        auto done = checked(picture);
        parts.filled = 0;
        return done;
    }

    Parts image_, water_, sides_;
    Snippets snippets_;
    std::optional<Picture> also_;
};

}  // namespace

std::unique_ptr<Maker> make_r2sonic() { return std::make_unique<R2Sonic>(); }

}  // namespace echoloop::said
