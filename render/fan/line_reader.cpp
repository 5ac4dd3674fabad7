#include "render/fan/line_reader.h"

#include <utility>

#include "render/fan/ping_motion.h"
#include "render/fan/range_scale.h"

namespace echoloop {

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

const float* LineReader::apply_motion(const BinningInput& in, const View& view, std::size_t line,
                                      const float* weight) {
    const PingMotion& motion = *in.motion;
    if (!motion.shifts && in.moment == 0) return weight;
    find_closing(motion, view, in.offset.of(view), line, row().surface(), closing);
    if (motion.shifts) {
        shift_ranges(motion, closing, extents.near);
        shift_ranges(motion, closing, extents.far);
    }
    if (in.moment == 0) return weight;
    weights.resize(view.samples);
    for (std::size_t i = 0; i < view.samples; ++i) {
        const float speed = closing[i] + static_cast<float>(motion.fastest);
        weights[i] = weight[i] * (in.moment == 1 ? speed : speed * speed);
    }
    return weights.data();
}

}  // namespace echoloop
