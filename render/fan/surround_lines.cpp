// The echo of the surround's lines, shared out to the sectors on both sides of where each pixel was sampled.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "render/fan/far_lobes.h"
#include "render/fan/line_sums.h"
#include "render/fan/range_scale.h"
#include "render/fan/turned_surround.h"

namespace echoloop {
namespace {

constexpr std::size_t first_of(SectorKind kind) { return static_cast<std::size_t>(kind) * sectors_per_array; }

/// A kind of sectors that hears anything of a line: how much of each pixel, and its first sector.
struct Hearers {
    const std::vector<float>* heard;
    std::size_t first;
};

/// A single beam's only sector is the first of all.
std::span<const Hearers> hearers_of(const SurroundHearing& of, bool single, std::array<Hearers, 2>& room) {
    std::size_t count = 0;
    if (of.any_beside) room[count++] = {&of.beside, single ? 0 : first_of(SectorKind::beside)};
    if (of.any_off_plane) room[count++] = {&of.off_plane, first_of(SectorKind::off_plane)};
    return std::span(room).first(count);
}

/// Calls add(sector, share) for both sectors that hear the share `all` of a pixel.
template <typename Add>
void each_of_both(std::size_t sector, float next, float all, const Add& add) {
    add(sector, all * (1 - next));
    if (next > 0) add(sector + 1, all * next);
}

/// What of a line is still under way.
void add_water(const BinningInput& in, const View& view, std::size_t line, std::span<const Hearers> hearers,
               LineReader& reader, std::span<UnderWay> under_way) {
    const Reverberation& water = *in.water;
    const PixelRow& row = reader.row();
    const SurroundHearing& hearing = reader.hearing;
    const auto each = [&](const auto& add) {
        for (const Hearers& by : hearers)
            for (std::size_t i = 0; i < view.samples; ++i)
                if (const float all = (*by.heard)[i]; all > 0)
                    each_of_both(by.first + static_cast<std::size_t>(hearing.sector[i]), hearing.next[i], all,
                                 [&](std::size_t sector, float share) { add(i, under_way[sector], share); });
    };
    if (!water.by_depth()) {
        reader.ends.find(water, row.range(), row.surface(), view.samples);
        return each([&](std::size_t i, UnderWay& sector, float share) { sector.add(reader.ends, i, share); });
    }
    const auto rise = water.rise(view, view.x(static_cast<double>(line) + 0.5 + in.offset.surround.line));
    const auto top = static_cast<float>(view.y(0.5 + in.offset.surround.sample)),
               step = static_cast<float>(view.sample_height());
    each([&](std::size_t i, UnderWay& sector, float share) {
        const float end =
            row.surface()[i] != 0 ? water.place(row.range()[i]) : std::numeric_limits<float>::infinity();
        sector.add(end, rise.at(top - static_cast<float>(i) * step), share);
    });
}

/// Echoes as strong as pixels hear them, with `weight` for what they hear.
void find_strengths(const BinningInput& in, const BinGain& gain, bool only_wanted, const View& view,
                    std::size_t line, const float* weight, LineReader& reader) {
    const PixelRow& row = reader.row();
    LineEchoes& echoes = reader.echoes;
    const std::size_t samples = view.samples;
    find_amounts(row.arrays(), weight, in.strength, only_wanted ? in.wanted : std::span<const std::uint8_t>(),
                 samples, echoes);
    gain.correct(row.range(), echoes.low.data(), echoes.high.data(), samples, echoes.amount.data());
    if (const float* focus = focus_of(in, view, line)) multiply(focus, samples, echoes.amount.data());
    if (in.motion != nullptr) multiply(reader.weights.data(), samples, echoes.amount.data());
}

/// Of one kind of sectors.
void add_echoes(const BinningInput& in, const View& view, const Hearers& by, bool with_surface,
                LineReader& reader) {
    const SurroundHearing& hearing = reader.hearing;
    const LineEchoes& echoes = reader.echoes;
    const EchoArrays arrays{echoes.low.data(), echoes.high.data(), echoes.amount.data(), echoes.slope.data()};
    if (in.plan.beams.size() == 1)
        reader.of_sectors.add(arrays, view.samples);
    else
        reader.of_sectors.add(arrays, by.first, hearing.sector.data(), hearing.next.data(), view.samples);
    if (!with_surface || !reader.meets_water()) return;
    const float surface = in.water->surface_number(),
                per_bin = 1 / static_cast<float>(in.water->steps().bins);
    for (std::size_t i = 0; i < view.samples; ++i)
        if (reader.row().surface()[i] == surface && echoes.amount[i] > 0)
            each_of_both(by.first + static_cast<std::size_t>(hearing.sector[i]), hearing.next[i],
                         echoes.amount[i], [&](std::size_t sector, float share) {
                             reader.of_surface.add(sector, echoes.low[i] * per_bin, echoes.high[i] * per_bin,
                                                   share);
                         });
}

/// Echoes of strength 1 that come back to a receiver which has turned meanwhile. What is heard from where the
/// level views look, but was sent beside, is heard in main lobes, too, as what lies above and below.
void add_turned(const BinningInput& in, const View& view, const TurnedSurround& turning, bool with_surface,
                LineReader& reader) {
    const bool single = in.plan.beams.size() == 1;
    const SurroundHearing& hearing = reader.hearing;
    const LineEchoes& echoes = reader.echoes;
    const PixelRow& row = reader.row();
    const float water = with_surface ? in.water->surface_number() : -1,
                per_bin = with_surface ? 1 / static_cast<float>(in.water->steps().bins) : 0;
    for (std::size_t i = 0; i < view.samples; ++i) {
        if (!(echoes.amount[i] > 0)) continue;
        const Turned turned = turning.at(i, row.range()[i], hearing.place[i]);
        const float strength = echoes.amount[i] * turned.kept;
        constexpr auto last = static_cast<float>(sectors_per_array - 2);
        const float at = single ? 0 : hearing.place[i] + turned.sectors, inside = std::clamp(at, 0.0F, last);
        const auto sector = static_cast<std::int32_t>(inside);
        const float next = std::clamp(at - static_cast<float>(sector), 0.0F, 1.0F);
        const auto add = [&](std::size_t first, float share) {
            const auto deposit = [&](std::size_t to, float amount) {
                reader.of_sectors.add(to, echoes.low[i], echoes.high[i], amount);
                if (row.surface()[i] == water)
                    reader.of_surface.add(to, echoes.low[i] * per_bin, echoes.high[i] * per_bin, amount);
            };
            each_of_both(first + static_cast<std::size_t>(sector), next, share * strength, deposit);
        };
        const auto both = [&](SectorKind kind, float heard) {
            if (!(heard > 0)) return;
            if (single) return add(0, heard);
            if (turned.far != 0) add(first_of(kind), turned.far * heard);
            if (kind == SectorKind::off_plane && turned.ahead != 0)
                add(first_of(SectorKind::ahead), turned.ahead * heard);
        };
        both(turned.inside ? SectorKind::off_plane : SectorKind::beside, hearing.beside[i]);
        both(SectorKind::off_plane, hearing.off_plane[i]);
    }
}

}  // namespace

void add_surround_line(const BinningInput& in, const BinGain& gain, bool only_wanted, const View& view,
                       std::size_t line, LineReader& reader, LineSums& sums, std::span<UnderWay> under_way) {
    reader.read_alone(in, view, line);
    find_extents(reader.row(), view, reader.extents);
    const bool single = in.plan.beams.size() == 1, with_water = !under_way.empty();
    const std::size_t first = view.first_pixel + line * view.samples - in.plan.first_surround_pixel;
    reader.hearing.find(std::span(in.plan.surround).subspan(first, view.samples), in.offset.surround, single);
    std::array<Hearers, 2> room{};
    const auto hearers = hearers_of(reader.hearing, single, room);
    if (with_water) add_water(in, view, line, hearers, reader, under_way);
    if (in.motion != nullptr) {
        reader.weights.assign(view.samples, 1.0F);
        reader.apply_motion(in, view, line, reader.weights.data());
    }
    LineEchoes& echoes = reader.echoes;
    echoes.resize(view.samples);
    find_places(reader.row().arrays(), reader.extents, scale_of(in), view.samples, echoes);
    const TurnedSurround turning(in, view, line);
    if (turning.turns()) {
        static thread_local std::vector<float> ones;
        ones.assign(view.samples, 1.0F);
        find_strengths(in, gain, only_wanted, view, line, ones.data(), reader);
        add_turned(in, view, turning, with_water, reader);
    } else {
        for (const Hearers& by : hearers) {
            find_strengths(in, gain, only_wanted, view, line, by.heard->data(), reader);
            add_echoes(in, view, by, with_water, reader);
        }
    }
    reader.of_sectors.deposit(sums);
    reader.of_surface.deposit_in_steps(sums);
}

}  // namespace echoloop
