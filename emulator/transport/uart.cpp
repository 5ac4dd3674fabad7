#include "emulator/transport/uart.h"

#include <cmath>
#include <optional>

namespace echoloop::uart {
namespace {

constexpr double tolerance = 0.03;
constexpr std::size_t frame_bits = 10, data_bits = 8;

/// The level of the line, bit after bit of the sender; it rests (high) before and after.
class Line {
  public:
    explicit Line(ByteView sent) : sent_(sent) {}

    bool high(std::size_t bit) const {
        if (bit >= end()) return true;
        const std::size_t place = bit % frame_bits;
        if (place == 0) return false;
        return place > data_bits || (sent_[bit / frame_bits] >> (place - 1) & 1) != 0;
    }
    /// The level `bits` after the first start bit began.
    bool high_at(double bits) const { return bits >= static_cast<double>(end()) || high(index(bits)); }

    /// The first falling edge at `from` or behind it, where an edge between two bits counts.
    std::optional<std::size_t> fall(std::size_t from) const {
        for (std::size_t bit = from; bit < end(); ++bit)
            if (!high(bit) && (bit == 0 || high(bit - 1))) return bit;
        return {};
    }
    std::optional<std::size_t> fall_after(double bits) const {
        if (bits >= static_cast<double>(end())) return {};
        return fall(index(bits) + 1);
    }

  private:
    static std::size_t index(double bits) { return static_cast<std::size_t>(bits); }
    std::size_t end() const { return sent_.size() * frame_bits; }

    ByteView sent_;
};

struct Sampled {
    std::uint8_t byte;
    bool stop;
};

/// `bit`: the length of one of the receiver's bits in those of the sender.
Sampled sample(const Line& line, double edge, double bit) {
    std::uint8_t byte = 0;
    for (std::size_t i = 0; i < data_bits; ++i)
        if (line.high_at(edge + (static_cast<double>(i) + 1.5) * bit))
            byte = static_cast<std::uint8_t>(byte | 1u << i);
    return {byte, line.high_at(edge + (data_bits + 1.5) * bit)};
}

void hand_over(Bytes& heard, const Sampled& sampled, const Receiver& receiver) {
    const BadByte fate = sampled.stop        ? BadByte::as_sampled
                         : sampled.byte == 0 ? receiver.line_break
                                             : receiver.framing_error;
    if (fate != BadByte::nothing) heard.push_back(fate == BadByte::zero ? std::uint8_t{0} : sampled.byte);
}

}  // namespace

bool agree(double one_rate, double other_rate) {
    return std::abs(one_rate - other_rate) <= tolerance * other_rate;
}

Bytes as_heard(ByteView sent, double sent_rate, const Receiver& receiver) {
    const Line line(sent);
    const double bit = sent_rate / receiver.rate;
    Bytes heard;
    auto edge = line.fall(0);
    while (edge) {
        const auto begin = static_cast<double>(*edge);
        const double middle = begin + 0.5 * bit;
        if (line.high_at(middle)) {  // a spike, no start bit
            edge = line.fall_after(middle);
            continue;
        }
        hand_over(heard, sample(line, begin, bit), receiver);
        edge = line.fall_after(begin + (data_bits + 1.5) * bit);
    }
    return heard;
}

}  // namespace echoloop::uart
