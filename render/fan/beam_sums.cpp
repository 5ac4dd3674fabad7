#include "render/fan/beam_sums.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "render/fan/far_lobes.h"
#include "render/fan/ping_motion.h"
#include "render/fan/weighted_rows.h"

namespace echoloop {

bool turns_lines(const BinningInput& in) {
    return in.motion != nullptr && in.motion->turning.z != 0 && !in.plan.across.empty();
}

/// Several sectors at once; nothing else is in those of lines.
void BeamSums::sum_sectors(const FanPlan& plan, LineSums& lines, Workers& workers) {
    if (plan.line_sector.empty() || plan.beams.size() == 1) return;
    static_assert(sectors_per_array % sums_at_once == 0);
    workers.run(sectors_per_array / sums_at_once, [&](std::size_t piece) {
        thread_local std::vector<WeightedRow> rows;
        rows.clear();
        const std::size_t first = piece * sums_at_once, last = first + sums_at_once, bins = lines.stride();
        std::size_t begin = bins, end = 0;
        FilledBins filled{0};
        for (std::size_t line = 0; line < plan.lines; ++line) {
            const SectorShare share = plan.line_sector[line];
            const std::size_t own = share.sector, next = own + 1;
            if (next < first || own >= last) continue;
            WeightedRow row{lines.line_values(line), lines.filled_line(line), {}};
            if (row.filled.bits == 0) continue;
            const LineBins& bins_of_line = lines.line(line);
            if (own >= first) row.weights[own - first] = 1 - share.next;
            if (next < last) row.weights[next - first] = share.next;
            begin = std::min(begin, bins_of_line.begin()), end = std::max(end, bins_of_line.end());
            filled = filled | bins_of_line.filled();
            rows.push_back(row);
        }
        if (rows.empty()) return;
        sum_rows(rows, nullptr, bins, sums_at_once, lines.sector_values(first));
        for (std::size_t sector = first; begin < end && sector < last; ++sector)
            lines.sector(sector).cover(begin, end, filled);
    });
}

void BeamSums::sum_turned_sectors(const BinningInput& in, LineSums& lines) const {
    const FanPlan& plan = in.plan;
    if (plan.line_sector.empty()) return;
    const double sector = std::numbers::pi / (sectors_per_array - 1);
    for (const Stretch& stretch : stretches_of(in, sector / 10, lines.steps() > 0))
        for (std::size_t line = 0; line < plan.lines; ++line) {
            // A beam that sends as it receives hears best half-way.
            const double bearing =
                double{bearings_[line]} + double{stretch.turned} / plan.geometry.horizontal.ways;
            const bool inside = bearing > plan.first_edge && bearing < plan.last_edge;
            const SectorShare share =
                sector_at(plan, inside ? SectorKind::lines : SectorKind::beside, bearing - plan.centre);
            const float common = plan.common_far.empty() ? 1 : plan.common_far.at(stretch.turned);
            const std::array<float, 2> weights{common * (1 - share.next), common * share.next};
            for (std::size_t k = 0; k < 2; ++k) {
                const std::size_t to = share.sector + k;
                if (stretch.begin < in.bins) {
                    const LineBins& row = lines.line(line);
                    const std::size_t begin = std::max(row.begin(), stretch.begin),
                                      end = std::min(row.end(), stretch.end);
                    if (begin < end) lines.sector(to).add(lines.line_values(line), weights[k], begin, end);
                } else {
                    const float* from = lines.line_steps(line);
                    float* sums = lines.sector_steps(to);
                    for (std::size_t i = stretch.begin - in.bins; i < stretch.end - in.bins; ++i)
                        sums[i] += weights[k] * from[i];
                }
            }
        }
}

void BeamSums::sum_nodes(const FarLobes& far, LineSums& lines, Workers& workers) {
    const std::size_t bins = lines.stride();
    node_stride_ = bins;
    nodes_.resize(far.nodes * bins);
    filled_nodes_ = {0};
    for (std::size_t s = 0; s < far.sectors; ++s) filled_nodes_ = filled_nodes_ | lines.filled_sector(s);
    workers.run((far.nodes + sums_at_once - 1) / sums_at_once, [&](std::size_t piece) {
        thread_local std::vector<WeightedRow> rows;
        rows.clear();
        const std::size_t first = piece * sums_at_once, count = std::min(sums_at_once, far.nodes - first);
        for (std::size_t s = 0; s < far.sectors; ++s) {
            WeightedRow row{lines.sector_values(s), lines.filled_sector(s), {}};
            if (row.filled.bits == 0) continue;
            for (std::size_t k = 0; k < count; ++k)
                row.weights[k] = far.weight[(first + k) * far.sectors + s];
            // Of what lies beside a fan its beams hear nothing in the sectors within.
            if (row.weights != std::array<float, sums_at_once>{}) rows.push_back(row);
        }
        sum_rows(rows, nullptr, bins, count, &nodes_[first * bins]);
    });
}

/// The far lobes of beam `beam`, sum `k` of those at hand, between the two nodes beside it.
void BeamSums::add_far(const FanPlan& plan, std::size_t beam, std::size_t k,
                       std::vector<WeightedRow>& rows) const {
    const FarLobes& far = plan.far_lobes;
    const std::size_t node = beam / far.beams_per_node, next = std::min(node + 1, far.nodes - 1);
    const std::size_t next_beam = std::min((node + 1) * far.beams_per_node, plan.beams.size() - 1);
    const std::size_t step = next_beam - node * far.beams_per_node;
    const float share =
        step > 0 ? static_cast<float>(beam - node * far.beams_per_node) / static_cast<float>(step) : 0.0F;
    for (const auto& [at, weight] : {std::pair(node, 1 - share), {next, share}}) {
        const float* values = &nodes_[at * node_stride_];
        const auto known = std::ranges::find(rows, values, &WeightedRow::values);
        WeightedRow& row =
            known != rows.end() ? *known : rows.emplace_back(WeightedRow{values, filled_nodes_, {}});
        row.weights[k] += weight;
    }
}

void BeamSums::find_bearings(const FanPlan& plan, PixelOffset offset) {
    bearings_.clear();
    if (plan.across.empty()) return;
    for (const View& view : std::span(plan.views).first(plan.level_views))
        for (std::size_t line = 0; line < view.lines; ++line)
            bearings_.push_back(
                static_cast<float>(view.bearing_at(static_cast<double>(line) + 0.5 + offset.line)));
}

float BeamSums::weight_of(const FanPlan& plan, const BeamLines& own, std::size_t i) const {
    if (bearings_.empty()) return plan.line_weight[own.first_weight + i];
    return plan.across.at(bearings_[own.first_line + i] - static_cast<float>(own.bearing));
}

/// Of beams first..first + count - 1.
void BeamSums::sum_beams(const FanPlan& plan, std::size_t first, std::size_t count, std::size_t bins,
                         LineSums& lines, const float* gain, float* out) const {
    thread_local std::vector<WeightedRow> rows;
    rows.clear();
    const auto own = std::span(plan.beams).subspan(first, count);
    std::size_t begin = own.front().first_line, end = begin;
    for (const BeamLines& beam : own) {
        begin = std::min(begin, beam.first_line);
        end = std::max(end, beam.first_line + beam.lines);
    }
    for (std::size_t line = begin; line < end; ++line) {
        const FilledBins filled = lines.filled_line(line);
        if (filled.bits == 0) continue;
        WeightedRow& row = rows.emplace_back(WeightedRow{lines.line_values(line), filled, {}});
        for (std::size_t k = 0; k < count; ++k)
            if (line >= own[k].first_line && line < own[k].first_line + own[k].lines)
                row.weights[k] = weight_of(plan, own[k], line - own[k].first_line);
    }
    for (std::size_t k = 0; k < count && plan.far_lobes.sectors > 0; ++k) add_far(plan, first + k, k, rows);
    sum_rows(rows, gain, bins, count, out);
}

std::vector<BeamSums::Stretch> BeamSums::stretches_of(const BinningInput& in, double step, bool with_water) {
    constexpr std::size_t whole = 16;  // bins that the loops take at once
    std::vector<Stretch> stretches;
    const double first = in.first_range, bin = in.bin_length;
    const auto turned = [&](double range) { return in.motion->turning.z * in.motion->flight(range); };
    const double all = std::abs(turned(first + static_cast<double>(in.bins) * bin) - turned(first));
    const double wished = std::ceil(all / step) + 1;
    const auto most = static_cast<std::size_t>(static_cast<double>(in.bins) / wished);
    const std::size_t length = std::max(most / whole * whole, whole);
    for (std::size_t begin = 0; begin < in.bins; begin += length) {
        const std::size_t end = std::min(begin + length, in.bins);
        const double middle = first + static_cast<double>(begin + end) / 2 * bin;
        stretches.push_back({begin, end, static_cast<float>(turned(middle))});
    }
    if (with_water) add_steps_of_water(in, stretches);
    return stretches;
}

/// A few stretches of steps, as what is everywhere sounds alike from other bearings; each by itself where
/// beams lose of it as they turn, since they send as they receive.
void BeamSums::add_steps_of_water(const BinningInput& in, std::vector<Stretch>& stretches) {
    const std::size_t at_once = in.plan.common_far.empty() ? 16 : 1;  // 16: as many as the loops take
    const RangeSteps& steps = in.water->steps();
    for (std::size_t kind = 0; kind < 2; ++kind)
        for (std::size_t step = 0; step < steps.count; step += at_once) {
            const std::size_t end = std::min(step + at_once, steps.count);
            const double middle = static_cast<double>((step + end) * steps.bins) / 2;
            const double range = in.first_range + middle * in.bin_length;
            const std::size_t behind = in.bins + kind * steps.count;
            stretches.push_back({behind + step, behind + end,
                                 static_cast<float>(in.motion->turning.z * in.motion->flight(range))});
        }
}

/// The lines as far to both sides of where a beam looks by then, or half-way there, as `own` are before.
/// `last`: those of the stretch before, which lie beside them.
BeamLines BeamSums::turned_lines(const FanPlan& plan, const BeamLines& own, const BeamLines& last,
                                 float turned) const {
    const float shift = plan.geometry.horizontal.ways == 2 ? -turned / 2 : -turned;
    const auto line_at = [this](float bearing, std::size_t line) {
        while (line > 0 && bearings_[line - 1] >= bearing) --line;
        while (line < bearings_.size() && bearings_[line] < bearing) ++line;
        return line;
    };
    BeamLines out = own;
    out.first_line = line_at(bearings_[own.first_line] + shift, last.first_line);
    out.lines = line_at(bearings_[own.first_line + own.lines - 1] + shift, last.first_line + last.lines) -
                out.first_line;
    return out;
}

/// As sum_beams(), of a fan that turns.
void BeamSums::sum_turned(const FanPlan& plan, std::size_t first, std::size_t count, std::size_t bins,
                          LineSums& lines, const float* gain, float* out) const {
    thread_local std::vector<WeightedRow> rows;
    thread_local std::vector<float> sums;
    thread_local std::array<std::vector<float>, sums_at_once> weights;
    thread_local std::vector<WeightedRow> far;
    far.clear();
    for (std::size_t k = 0; k < count && plan.far_lobes.sectors > 0; ++k) add_far(plan, first + k, k, far);
    std::array<BeamLines, sums_at_once> own{};
    std::copy_n(plan.beams.begin() + static_cast<std::ptrdiff_t>(first), count, own.begin());
    for (const auto& [begin, end, turned] : stretches_) {
        rows.clear();
        std::size_t from = plan.lines, to = 0;
        for (std::size_t k = 0; k < count; ++k) {
            own[k] = turned_lines(plan, plan.beams[first + k], own[k], turned);
            lobe_.weigh(std::span(bearings_).subspan(own[k].first_line, own[k].lines),
                        static_cast<float>(own[k].bearing), turned, weights[k]);
            from = std::min(from, own[k].first_line), to = std::max(to, own[k].first_line + own[k].lines);
        }
        const std::size_t length = end - begin;
        const int shift = FilledBins::shift_of(length);
        const auto add = [&](const float* values, std::size_t low, std::size_t high) -> WeightedRow& {
            const auto filled =
                FilledBins::within(std::max(low, begin) - begin, std::min(high, end) - begin, shift);
            return rows.emplace_back(WeightedRow{values + begin, filled, {}});
        };
        for (std::size_t line = from; line < to; ++line) {
            const LineBins& bins_of_line = lines.line(line);
            const bool of_water = begin >= bins - 2 * lines.steps();
            if (!of_water && (bins_of_line.end() <= begin || bins_of_line.begin() >= end)) continue;
            WeightedRow& row = of_water
                                   ? add(lines.line_values(line), begin, end)
                                   : add(lines.line_values(line), bins_of_line.begin(), bins_of_line.end());
            for (std::size_t k = 0; k < count; ++k) {
                if (line < own[k].first_line || line >= own[k].first_line + own[k].lines) continue;
                row.weights[k] = weights[k][line - own[k].first_line];
            }
        }
        for (const WeightedRow& row : far) rows.push_back({row.values + begin, {}, row.weights});
        sums.resize(count * length);
        sum_rows(rows, gain != nullptr ? gain + begin : nullptr, length, count, sums.data());
        for (std::size_t k = 0; k < count; ++k)
            std::copy_n(&sums[k * length], length, out + k * bins + begin);
    }
}

/// What the beams need of all lines, and of everything far off their axes.
void BeamSums::sum_far(const BinningInput& in, LineSums& lines, Workers& workers) {
    const FanPlan& plan = in.plan;
    find_bearings(plan, in.offset.level);
    stretches_.clear();
    if (turns_lines(in)) {
        lobe_ = TurnedLobe(plan);
        const double step = std::min(0.2 * plan.geometry.beam_width, deg_to_rad(0.05));
        stretches_ = stretches_of(in, step, lines.steps() > 0);
        sum_turned_sectors(in, lines);
    } else {
        sum_sectors(plan, lines, workers);
    }
    if (plan.far_lobes.sectors > 0) sum_nodes(plan.far_lobes, lines, workers);
}

void BeamSums::sum_some(const BinningInput& in, std::size_t first, std::size_t count, LineSums& lines,
                        const std::vector<float>& gain, float* out) const {
    const float* factors = gain.empty() ? nullptr : gain.data();
    if (stretches_.empty())
        sum_beams(in.plan, first, count, lines.length(), lines, factors, out);
    else
        sum_turned(in.plan, first, count, lines.length(), lines, factors, out);
}

void BeamSums::sum(const BinningInput& in, LineSums& lines, const std::vector<float>& gain, Workers& workers,
                   std::vector<float>& values) {
    const std::size_t beams = in.plan.beams.size(), bins = lines.length();
    values.resize(beams * bins);
    sum_far(in, lines, workers);
    workers.run((beams + sums_at_once - 1) / sums_at_once, [&](std::size_t piece) {
        const std::size_t first = piece * sums_at_once;
        sum_some(in, first, std::min(sums_at_once, beams - first), lines, gain, &values[first * bins]);
    });
}

void BeamSums::sum_into(const BinningInput& in, LineSums& lines, const std::vector<float>& gain,
                        Workers& workers, const Take& take) {
    const std::size_t beams = in.plan.beams.size();
    sum_far(in, lines, workers);
    workers.run((beams + sums_at_once - 1) / sums_at_once, [&](std::size_t piece) {
        thread_local std::vector<float> rows;
        const std::size_t first = piece * sums_at_once, count = std::min(sums_at_once, beams - first);
        if (rows.size() < sums_at_once * lines.length()) rows.resize(sums_at_once * lines.length());
        sum_some(in, first, count, lines, gain, rows.data());
        take(first, count, rows.data());
    });
}

}  // namespace echoloop
