#include "render/fan/beam_sums.h"

#include <span>

#include "render/simd.h"

namespace echoloop {
namespace {

ECHOLOOP_SIMD
void add_scaled(float* __restrict sum, const float* __restrict values, float weight, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) sum[i] += weight * values[i];
}

ECHOLOOP_SIMD
void multiply(float* __restrict values, const float* __restrict factors, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) values[i] *= factors[i];
}

/// Adds the bins of a row that hold anything.
void add_row(float* sum, const LineBins& row, const float* values, float weight) {
    if (!row.empty()) add_scaled(sum + row.begin(), values + row.begin(), weight, row.end() - row.begin());
}

}  // namespace

void BeamSums::sum_sectors(const FanPlan& plan, LineSums& lines) {
    if (plan.line_sector.empty()) return;
    for (const FanPart& part : plan.parts)
        for (std::size_t line = part.first_line; part.beams > 1 && line < part.first_line + part.lines;
             ++line)
            if (const LineBins& row = lines.line(line); !row.empty()) {
                const SectorShare share = plan.line_sector[line];
                const float* values = lines.line_values(line);
                lines.sector(share.sector).add(values, 1 - share.next, row.begin(), row.end());
                lines.sector(share.sector + 1U).add(values, share.next, row.begin(), row.end());
            }
}

void BeamSums::sum_nodes(const FanPlan&, const FanPart& part, std::size_t bins, LineSums& lines,
                         Workers& workers) {
    nodes_.assign(part.nodes * bins, 0.0F);
    workers.run(part.nodes, [&](std::size_t node) {
        for (std::size_t s = 0; s < part.sectors; ++s)
            if (const float weight = part.far[node * part.sectors + s]; weight > 0)
                add_row(&nodes_[node * bins], lines.sector(part.first_sector + s),
                        lines.sector_values(part.first_sector + s), weight);
    });
}

void BeamSums::add_far(const FanPart& part, std::size_t beam, std::size_t bins, float* sum) const {
    const std::size_t node = beam / part.beams_per_node, next = std::min(node + 1, part.nodes - 1);
    const std::size_t next_beam = std::min((node + 1) * part.beams_per_node, part.beams - 1);
    const std::size_t step = next_beam - node * part.beams_per_node;
    const float share =
        step > 0 ? static_cast<float>(beam - node * part.beams_per_node) / static_cast<float>(step) : 0.0F;
    add_scaled(sum, &nodes_[node * bins], 1 - share, bins);
    if (share > 0) add_scaled(sum, &nodes_[next * bins], share, bins);
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

void BeamSums::sum(const FanPlan& plan, PixelOffset offset, std::size_t bins, LineSums& lines,
                   const std::vector<float>& gain, Workers& workers, std::vector<float>& values) {
    values.resize(plan.beams.size() * bins);
    sum_sectors(plan, lines);
    find_bearings(plan, offset);
    for (const FanPart& part : plan.parts) {
        if (part.sectors > 0) sum_nodes(plan, part, bins, lines, workers);
        constexpr std::size_t beams_at_once = 16;
        workers.run((part.beams + beams_at_once - 1) / beams_at_once, [&](std::size_t piece) {
            const std::size_t end = std::min((piece + 1) * beams_at_once, part.beams);
            for (std::size_t beam = piece * beams_at_once; beam < end; ++beam) {
                const BeamLines& own = plan.beams[part.first_beam + beam];
                float* sum = &values[(part.first_beam + beam) * bins];
                std::fill(sum, sum + bins, 0.0F);
                for (std::size_t i = 0; i < own.lines; ++i)
                    if (const float weight = weight_of(plan, own, i); weight > 0)
                        add_row(sum, lines.line(own.first_line + i), lines.line_values(own.first_line + i),
                                weight);
                if (part.sectors > 0) add_far(part, beam, bins, sum);
                if (!gain.empty()) multiply(sum, gain.data(), bins);
            }
        });
    }
}

}  // namespace echoloop
