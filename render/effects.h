// The physical effects that make up an echo; a scenario switches each off or on by its name. Names only: what
// an effect does is written where it is done. Standard library only.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <string_view>

namespace echoloop {

enum class Effect : unsigned char {
    spreading,
    absorption,
    beam_pattern,
    side_lobes,
    pulse,
    speckle,
    noise,
    multipath,
    second_time_around,
    cross_talk,
    tvg,
    saturation,
    quantisation,
    sensor_noise,
    ping_jitter,
    ring_down,
    interference,
    array_errors,
    reverberation,
    texture,
    refraction,
    motion,
};

struct EffectRow {
    Effect effect;
    std::string_view name;  ///< the key under `effects:` in a scenario
    std::string_view help;  ///< what is different when it is off
};

inline constexpr std::array<EffectRow, 22> effect_rows{{
    {Effect::spreading, "spreading", "two-way spherical spreading, 40 log R; off: none"},
    {Effect::absorption, "absorption", "Francois & Garrison; off: none"},
    {Effect::beam_pattern, "beam_pattern", "beams of the aperture's shape; off: boxes of the nominal widths"},
    {Effect::side_lobes, "side_lobes", "echoes from outside the main lobes; off: none"},
    {Effect::pulse, "pulse",
     "the pulse's length or bandwidth limits range resolution; off: every echo in one bin"},
    {Effect::speckle, "speckle", "interference of many scatterers; off: mean levels"},
    {Effect::noise, "noise", "thermal and self noise; off: silence"},
    {Effect::multipath, "multipath",
     "mirrors: glints of faces, echoes by way of surface, bottom and corners; off: diffuse direct echoes "
     "only"},
    {Effect::second_time_around, "second_time_around", "late echoes of the ping before; off: none"},
    {Effect::cross_talk, "cross_talk", "pulses of other sonars in the same band; off: none"},
    {Effect::tvg, "tvg", "the receiver's time-varied gain; off: constant gain"},
    {Effect::saturation, "saturation", "the receiver's input clips; off: never"},
    {Effect::quantisation, "quantisation",
     "steps of the receiver's converter; off: only those of the wire's format"},
    {Effect::sensor_noise, "sensor_noise",
     "temperatures, voltages, pressures and compasses drift and scatter; off: as they are set"},
    {Effect::ping_jitter, "ping_jitter", "the sonar's timer is uneven; off: the same interval each time"},
    {Effect::ring_down, "ring_down",
     "what the transducer's own pulse leaves in the receiver; off: nothing but echoes"},
    {Effect::interference, "interference",
     "lines and dashes from motors, supplies and other electronics; off: none"},
    {Effect::array_errors, "array_errors",
     "staves that differ in amplitude and phase; off: side lobes of the ideal aperture"},
    {Effect::reverberation, "reverberation",
     "what floats in the water, bubbles and waves at the surface; off: silence between echoes"},
    {Effect::texture, "texture", "patches of the bottom that scatter more or less; off: even materials"},
    {Effect::refraction, "refraction", "rays bend where the water has layers; off: straight rays"},
    {Effect::motion, "motion",
     "the sonar moves and turns while its ping is under way; off: it stands still for that time"},
}};

/// A set of effects; all are on to begin with.
class Effects {
  public:
    constexpr Effects() : on_((1ULL << effect_rows.size()) - 1) {}
    static constexpr Effects none() { return Effects(0); }

    bool has(Effect effect) const { return on_.test(static_cast<std::size_t>(effect)); }
    Effects& set(Effect effect, bool on = true) {
        on_.set(static_cast<std::size_t>(effect), on);
        return *this;
    }
    friend bool operator==(const Effects&, const Effects&) = default;

  private:
    explicit constexpr Effects(unsigned long long bits) : on_(bits) {}
    std::bitset<effect_rows.size()> on_;
};

/// The effect of that name, or empty.
inline std::optional<Effect> effect_by_name(std::string_view name) {
    for (const EffectRow& row : effect_rows)
        if (row.name == name) return row.effect;
    return std::nullopt;
}

}  // namespace echoloop
