#include "render/fan/line_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "render/fan/far_lobes.h"
#include "render/fan/patches.h"
#include "render/fan/ping_motion.h"
#include "render/fan/turned_surround.h"

namespace echoloop {
namespace {

/// m, of the window.
float end_of(const BinningInput& in) {
    return static_cast<float>(in.first_range + static_cast<double>(in.bins) * in.bin_length);
}

bool is_wanted(const BinningInput& in, float surface) {
    const auto index = static_cast<std::size_t>(surface) - 1;  // the water's surface has none
    return index < in.wanted.size() && in.wanted[index] != 0;
}

/// From m to bins, and what the gain of a whole bin leaves out.
class RangeScale {
  public:
    RangeScale(const BinningInput& in, const BinGain& gain)
        : gain_(gain),
          per_metre(static_cast<float>(1 / in.bin_length)),
          start_(static_cast<float>(in.first_range / in.bin_length)),
          near_limit_(static_cast<float>(gain.near_limit())) {}

    float bin(float range) const { return range * per_metre - start_; }
    bool is_near(float range) const { return range < near_limit_; }
    float near_limit() const { return near_limit_; }
    BinScale scale() const { return {per_metre, start_}; }
    /// `length`: bins, over which the echo is spread.
    float correction(float range, float length) const {
        return range < near_limit_ && length < 1 ? gain_.correction(range) : 1;
    }

  private:
    const BinGain& gain_;

  public:
    const float per_metre;

  private:
    float start_, near_limit_;
};

constexpr float nowhere = std::numeric_limits<float>::infinity();

/// Where the echo of the water's surface is added up in steps, too.
struct SurfaceSteps {
    float number = -1;  ///< as Pixel::surface; -1: nowhere
    LineBins bins{};
    float per_bin = 1;

    void deposit(float near, float far, float value) { bins.deposit(near * per_bin, far * per_bin, value); }
};

SurfaceSteps surface_steps(const BinningInput& in, float* steps) {
    const RangeSteps& of = in.water->steps();
    return {in.water->surface_number(), LineBins(steps + of.count, of.count),
            1 / static_cast<float>(of.bins)};
}

/// The paper's rule as a strength, which a table holds over the cosine.
const StrengthTable& sigmoid_table() {
    static const StrengthTable table(
        [](double cosine) { return cosine * double{cerqueira_sigmoid(static_cast<float>(cosine))}; });
    return table;
}

/// `weight`: of each sample.
void find_amounts(const BinningInput& in, Amount amount, const PixelRow& row, const float* weight,
                  std::size_t samples, LineEchoes& out) {
    switch (amount) {
        case Amount::echo:
            return find_amounts(row.arrays(), weight, in.strength, {}, samples, out);
        case Amount::wanted_echo:
            return find_amounts(row.arrays(), weight, in.strength, in.wanted, samples, out);
        case Amount::paper_echo:
            return find_amounts_alike(row.arrays(), weight, &sigmoid_table(), samples, out);
        case Amount::paper_share:
            return find_amounts_alike(row.arrays(), weight, nullptr, samples, out);
    }
}

/// Close to the sonar the gain of a whole bin leaves something out.
void correct_near(const RangeScale& scale, const float* range, std::size_t samples, LineEchoes& echoes) {
    if (!any_below(range, scale.near_limit(), samples)) return;
    for (std::size_t i = 0; i < samples; ++i)
        if (scale.is_near(range[i]) && echoes.amount[i] > 0)
            echoes.amount[i] *= scale.correction(range[i], echoes.high[i] - echoes.low[i]);
}

/// What of a line is still under way.
void add_volume(const BinningInput& in, const View& view, std::size_t line, const float* weight,
                LineReader& reader, float* steps) {
    const Reverberation& water = *in.water;
    const PixelRow& row = reader.row();
    UnderWay& under_way = reader.under_way;
    under_way.reset(water);
    if (!water.by_depth()) {
        under_way.add(water, row.range(), row.surface(), weight, view.samples);
        return under_way.scatter(water, steps);
    }
    const auto rise = water.rise(view, view.x(static_cast<double>(line) + 0.5 + in.offset.level.line));
    const auto top = static_cast<float>(view.y(0.5 + in.offset.level.sample)),
               step = static_cast<float>(view.sample_height());
    for (std::size_t i = 0; i < view.samples; ++i) {
        if (!(weight[i] > 0)) continue;
        const float end = row.surface()[i] != 0 ? water.place(row.range()[i]) : nowhere;
        under_way.add(end, rise.at(top - static_cast<float>(i) * step), weight[i]);
    }
    under_way.scatter(water, steps);
}

/// What a single beam hears of each sample, at the direction where it was taken: a line aperture tells
/// directions apart by their angle off its plane of symmetry, which for one bearing is the smaller the higher
/// it looks.
void weigh_beside(const BinningInput& in, const View& view, std::size_t line, const float* weight,
                  std::vector<float>& out) {
    const double x = view.x(static_cast<double>(line) + 0.5 + in.offset.level.line);
    const double turn = view.bearing - in.plan.beams.front().bearing;
    const auto aside = static_cast<float>(std::sin(turn) + x * std::cos(turn)),
               ahead = static_cast<float>(1 + x * x);
    const auto top = static_cast<float>(view.y(0.5 + in.offset.level.sample)),
               step = static_cast<float>(view.sample_height());
    out.resize(view.samples);
    weigh_by_lobe(in.plan.beside, {aside, ahead, top, step}, weight, view.samples, out.data());
}

}  // namespace

void LineSums::resize(std::size_t lines, std::size_t sectors, std::size_t bins, std::size_t steps) {
    if (bins == bins_ && steps == steps_ && lines == lines_.size() && sectors == sectors_.size()) {
        for (auto* rows : {&lines_, &sectors_})
            for (LineBins& row : *rows) row.clear();
        for (std::size_t i = 0; steps > 0 && i < lines + sectors; ++i)
            std::fill_n(line_steps(i), 2 * steps, 0.0F);
        return;
    }
    bins_ = bins, steps_ = steps;
    values_.assign((lines + sectors) * stride() + bins_at_once, 0.0F);
    lines_.clear(), sectors_.clear();
    for (std::size_t i = 0; i < lines; ++i) lines_.emplace_back(&values_[i * stride()], bins);
    for (std::size_t i = 0; i < sectors; ++i) sectors_.emplace_back(&values_[(lines + i) * stride()], bins);
}

void LineReader::read_alone(const BinningInput& in, const View& view, std::size_t line) {
    restart();
    meets_water_ = load(rows_[1], in, view, line);
}

bool LineReader::load(PixelRow& row, const BinningInput& in, const View& view, std::size_t line) {
    PlaneOfLine plane;
    const bool has_plane = in.water != nullptr && in.water->find_plane(view, line, in.offset.of(view), plane);
    row.load(&in.pixels[(view.first_line + line) * in.plan.samples], view.samples, end_of(in),
             has_plane ? &plane : nullptr);
    return has_plane;
}

void LineReader::read(const BinningInput& in, const View& view, std::size_t line) {
    const std::size_t number = view.first_line + line;
    const bool first = line == 0, last = line + 1 == view.lines;
    if (next_ == number) {
        std::swap(rows_[0], rows_[1]);
        std::swap(rows_[1], rows_[2]);
    } else {
        if (!first) load(rows_[0], in, view, line - 1);
        load(rows_[1], in, view, line);
    }
    if (!last) load(rows_[2], in, view, line + 1);
    next_ = last ? no_line : number + 1;
    first_ = first, last_ = last;
}

namespace {

/// Shifts the extents of the row that was read, and returns its weights, times the closing speeds that are
/// asked for.
const float* apply_motion(const BinningInput& in, const View& view, std::size_t line, const float* weight,
                          LineReader& reader) {
    const PingMotion& motion = *in.motion;
    if (!motion.shifts && in.moment == 0) return weight;
    find_closing(motion, view, in.offset.of(view), line, reader.row().surface(), reader.closing);
    if (motion.shifts) {
        shift_ranges(motion, reader.closing, reader.extents.near);
        shift_ranges(motion, reader.closing, reader.extents.far);
    }
    if (in.moment == 0) return weight;
    reader.weights.resize(view.samples);
    for (std::size_t i = 0; i < view.samples; ++i) {
        const float speed = reader.closing[i] + static_cast<float>(motion.fastest);
        reader.weights[i] = weight[i] * (in.moment == 1 ? speed : speed * speed);
    }
    return reader.weights.data();
}

}  // namespace

void add_level_line(const BinningInput& in, const BinGain& gain, Amount amount, const View& view,
                    std::size_t line, LineReader& reader, LineBins& bins, float* steps) {
    reader.read_alone(in, view, line);
    const std::size_t first = view.first_pixel + line * view.samples;
    const float* weight = is_echo(amount) ? &in.plan.weight[first] : &in.plan.coverage[first];
    const float* plain = weight;
    if (is_echo(amount) && !in.plan.beside.empty()) {
        weigh_beside(in, view, line, plain, reader.weights);
        weight = reader.weights.data();
    }
    if (steps != nullptr) add_volume(in, view, line, weight, reader, steps);
    if (is_echo(amount) && in.motion != nullptr && in.motion->turning != Vec3{} &&
        (!in.plan.beside.empty() || !in.motion->upwards.empty())) {
        weigh_turned(in.plan, *in.motion, view, in.offset.level, line, reader.row().range(),
                     reader.row().surface(), plain, reader.weights);
        weight = reader.weights.data();
    }
    find_spreads(reader.row(), view, static_cast<float>(in.bin_length), end_of(in), reader.extents);
    if (is_echo(amount) && in.patches != nullptr &&
        in.patches->weigh(reader.row(), view, line, in.offset.level, weight, reader.weights))
        weight = reader.weights.data();
    if (in.motion != nullptr) weight = apply_motion(in, view, line, weight, reader);
    LineEchoes& echoes = reader.echoes;
    const RangeScale scale(in, gain);
    const PixelRow& row = reader.row();
    const std::size_t samples = view.samples;
    echoes.resize(samples);
    find_amounts(in, amount, row, weight, samples, echoes);
    find_places(row.arrays(), reader.extents, scale.scale(), samples, echoes);
    if (is_echo(amount)) correct_near(scale, row.range(), samples, echoes);
    if (const float* focus = focus_of(in, view, line); focus != nullptr && is_echo(amount))
        multiply(focus, samples, echoes.amount.data());
    deposit_line(echoes, samples, bins);
    if (steps == nullptr || !reader.meets_water()) return;
    SurfaceSteps water = surface_steps(in, steps);
    for (std::size_t i = 0; i < samples; ++i)
        if (row.surface()[i] == water.number && echoes.amount[i] > 0)
            water.deposit(echoes.low[i], echoes.high[i], echoes.amount[i]);
}

namespace {

/// What sectors hear of a pixel.
struct Shares {
    /// Of a sector, and of the next one.
    struct Share {
        std::size_t sector;
        float own, next;
    };
    std::array<Share, 4> of;
    std::size_t count = 0;

    /// Calls add(sector, share) for each.
    template <typename Add>
    void each(const Add& add) const {
        for (const Share& share : std::span(of).first(count)) {
            if (share.own != 0) add(share.sector, share.own);
            if (share.next != 0) add(share.sector + 1, share.next);
        }
    }
};

/// Shares the echo of a surround pixel out to the sectors on both sides of where it was sampled.
class SectorSums {
  public:
    SectorSums(const FanPlan& plan, PixelOffset offset)
        : line_(static_cast<float>(offset.line)),
          sample_(static_cast<float>(offset.sample)),
          single_(plan.beams.size() == 1) {}

    /// Among the sectors, where the pixel was sampled.
    float place(const SurroundPixel& pixel) const { return pixel.sector.at(line_, sample_); }

    /// Of an echo of strength 1. What is heard from where the level views look, but was sent beside, is heard
    /// in main lobes, too, as what lies above and below.
    Shares shares(const SurroundPixel& pixel, const Turned& turned) const {
        Shares out;
        const float beside = pixel.beside.at(line_, sample_), off_plane = pixel.off_plane.at(line_, sample_);
        if (single_) {
            out.of[out.count++] = {0, beside + off_plane, 0};
            return out;
        }
        constexpr auto last = static_cast<float>(sectors_per_array - 2);
        const float at = place(pixel) + turned.sectors, inside = std::clamp(at, 0.0F, last);
        const auto sector = static_cast<std::int32_t>(inside);
        const float next = std::clamp(at - static_cast<float>(sector), 0.0F, 1.0F);
        const auto add = [&](SectorKind kind, float heard) {
            const std::size_t first = static_cast<std::size_t>(kind) * sectors_per_array;
            if (heard != 0)
                out.of[out.count++] = {first + static_cast<std::size_t>(sector), heard * (1 - next),
                                       heard * next};
        };
        const auto both = [&](SectorKind kind, float heard) {
            if (!(heard > 0)) return;
            add(kind, turned.far * heard);
            if (kind == SectorKind::off_plane) add(SectorKind::ahead, turned.ahead * heard);
        };
        both(turned.inside ? SectorKind::off_plane : SectorKind::beside, beside);
        both(SectorKind::off_plane, off_plane);
        return out;
    }

  private:
    const float line_, sample_;
    const bool single_;
};

}  // namespace

void add_surround_line(const BinningInput& in, const BinGain& gain, bool only_wanted, const View& view,
                       std::size_t line, LineReader& reader, LineSums& sums, std::span<UnderWay> under_way) {
    reader.read_alone(in, view, line);
    find_extents(reader.row(), view, reader.extents);
    const PixelRow& row = reader.row();
    const RangeScale scale(in, gain);
    const SectorSums sectors(in.plan, in.offset.surround);
    const TurnedSurround turning(in, view, line);
    const std::size_t first = view.first_pixel + line * view.samples;
    const SurroundPixel* pixels = &in.plan.surround[first - in.plan.first_surround_pixel];
    const float *weight = &in.plan.weight[first], *focus = focus_of(in, view, line);
    const bool moves = in.motion != nullptr;
    if (moves)
        reader.weights.assign(view.samples, 1.0F),
            apply_motion(in, view, line, reader.weights.data(), reader);
    const auto top = static_cast<float>(view.y(0.5 + in.offset.surround.sample)),
               step = static_cast<float>(view.sample_height());
    const double x = view.x(static_cast<double>(line) + 0.5 + in.offset.surround.line);
    const float water_surface = under_way.empty() ? -1 : in.water->surface_number();
    const float per_bin = under_way.empty() ? 0 : 1 / static_cast<float>(in.water->steps().bins);
    const auto rise = under_way.empty() ? Reverberation::Rise({}, 0) : in.water->rise(view, x);
    for (std::size_t i = 0; i < view.samples; ++i) {
        if (weight[i] == 0) continue;
        const SurroundPixel& pixel = pixels[i];
        const float surface = row.surface()[i], range = row.range()[i];
        Shares heard = sectors.shares(pixel, {});
        if (!under_way.empty()) {
            const float end = surface != 0 ? in.water->place(range) : nowhere;
            const float sine = in.water->by_depth() ? rise.at(top - static_cast<float>(i) * step) : 0;
            heard.each([&](std::size_t s, float share) { under_way[s].add(end, sine, share); });
        }
        if (surface == 0) continue;
        if (only_wanted && !is_wanted(in, surface)) continue;
        const float near = scale.bin(reader.extents.near[i]), far = scale.bin(reader.extents.far[i]);
        const float cosine = std::min(row.cosine()[i], 1.0F);
        float strength = in.strength[static_cast<std::size_t>(surface) - 1]->at(cosine) *
                         scale.correction(range, far - near);
        if (focus != nullptr) strength *= focus[i];
        if (moves) strength *= reader.weights[i];
        if (turning.turns()) {
            const Turned turned = turning.at(i, range, sectors.place(pixel));
            strength *= turned.kept;
            heard = sectors.shares(pixel, turned);
        }
        heard.each([&](std::size_t s, float share) {
            reader.of_sectors.add(s, near, far, share * strength);
            if (surface == water_surface)
                reader.of_surface.add(s, near * per_bin, far * per_bin, share * strength);
        });
    }
    reader.of_sectors.deposit(sums);
    reader.of_surface.deposit_in_steps(sums);
}

}  // namespace echoloop
