#include "render/fan/beam_sums.h"

#include <algorithm>
#include <span>
#include <utility>

#include "render/fan/weighted_rows.h"

namespace echoloop {

void BeamSums::sum_sectors(const FanPlan& plan, LineSums& lines) {
    if (plan.line_sector.empty() || plan.beams.size() == 1) return;
    for (std::size_t line = 0; line < plan.lines; ++line)
        if (const LineBins& row = lines.line(line); !row.empty()) {
            const SectorShare share = plan.line_sector[line];
            const float* values = lines.line_values(line);
            lines.sector(share.sector).add(values, 1 - share.next, row.begin(), row.end());
            lines.sector(share.sector + 1U).add(values, share.next, row.begin(), row.end());
        }
    for (std::size_t line = 0; lines.steps() > 0 && line < plan.lines; ++line) {
        const SectorShare share = plan.line_sector[line];
        const float* from = lines.line_steps(line);
        float *to = lines.sector_steps(share.sector), *next = lines.sector_steps(share.sector + 1U);
        for (std::size_t i = 0; i < 2 * lines.steps(); ++i)
            to[i] += (1 - share.next) * from[i], next[i] += share.next * from[i];
    }
}

/// A row's bins, where there are any, with the steps behind them.
void BeamSums::push(WeightedRow row, const LineSums& lines, std::size_t bins,
                    std::vector<WeightedRow>& rows) {
    if (lines.steps() > 0) {
        if (row.begin >= row.end) row.begin = bins - 2 * lines.steps();
        row.end = bins;
    }
    if (row.begin < row.end) rows.push_back(row);
}

void BeamSums::sum_nodes(const FarLobes& far, std::size_t bins, LineSums& lines, Workers& workers) {
    nodes_.resize(far.nodes * bins);
    workers.run((far.nodes + sums_at_once - 1) / sums_at_once, [&](std::size_t piece) {
        thread_local std::vector<WeightedRow> rows;
        rows.clear();
        const std::size_t first = piece * sums_at_once, count = std::min(sums_at_once, far.nodes - first);
        for (std::size_t s = 0; s < far.sectors; ++s) {
            const LineBins& sector = lines.sector(s);
            WeightedRow row{lines.sector_values(s), sector.begin(), sector.end(), {}};
            for (std::size_t k = 0; k < count; ++k)
                row.weights[k] = far.weight[(first + k) * far.sectors + s];
            push(row, lines, bins, rows);
        }
        sum_rows(rows, nullptr, bins, count, &nodes_[first * bins]);
    });
}

/// The far lobes of beam `beam`, sum `k` of those at hand, between the two nodes beside it.
void BeamSums::add_far(const FanPlan& plan, std::size_t beam, std::size_t k, std::size_t bins,
                       std::vector<WeightedRow>& rows) const {
    const FarLobes& far = plan.far_lobes;
    const std::size_t node = beam / far.beams_per_node, next = std::min(node + 1, far.nodes - 1);
    const std::size_t next_beam = std::min((node + 1) * far.beams_per_node, plan.beams.size() - 1);
    const std::size_t step = next_beam - node * far.beams_per_node;
    const float share =
        step > 0 ? static_cast<float>(beam - node * far.beams_per_node) / static_cast<float>(step) : 0.0F;
    for (const auto& [at, weight] : {std::pair(node, 1 - share), {next, share}}) {
        const float* values = &nodes_[at * bins];
        const auto known = std::ranges::find(rows, values, &WeightedRow::values);
        WeightedRow& row = known != rows.end() ? *known : rows.emplace_back(WeightedRow{values, 0, bins, {}});
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
        const LineBins& bins_of_line = lines.line(line);
        WeightedRow row{lines.line_values(line), bins_of_line.begin(), bins_of_line.end(), {}};
        for (std::size_t k = 0; k < count; ++k)
            if (line >= own[k].first_line && line < own[k].first_line + own[k].lines)
                row.weights[k] = weight_of(plan, own[k], line - own[k].first_line);
        push(row, lines, bins, rows);
    }
    for (std::size_t k = 0; k < count && plan.far_lobes.sectors > 0; ++k)
        add_far(plan, first + k, k, bins, rows);
    sum_rows(rows, gain, bins, count, out);
}

void BeamSums::sum(const FanPlan& plan, PixelOffset offset, std::size_t bins, LineSums& lines,
                   const std::vector<float>& gain, Workers& workers, std::vector<float>& values) {
    values.resize(plan.beams.size() * bins);
    sum_sectors(plan, lines);
    find_bearings(plan, offset);
    if (plan.far_lobes.sectors > 0) sum_nodes(plan.far_lobes, bins, lines, workers);
    const std::size_t beams = plan.beams.size();
    workers.run((beams + sums_at_once - 1) / sums_at_once, [&](std::size_t piece) {
        const std::size_t first = piece * sums_at_once, count = std::min(sums_at_once, beams - first);
        sum_beams(plan, first, count, bins, lines, gain.empty() ? nullptr : gain.data(),
                  &values[first * bins]);
    });
}

}  // namespace echoloop
