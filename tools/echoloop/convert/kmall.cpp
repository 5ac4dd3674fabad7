// .kmall: datagrams back to back, whole; installation, runtime parameters and the sound speed profile first.
#include <array>

#include "protocols/kmall/codec.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"
#include "tools/echoloop/convert/recording.h"

namespace echoloop::convert {
namespace {

constexpr std::size_t header_bytes = 20, partition_bytes = 4, tail_bytes = 4;
constexpr std::array<std::string_view, 3> first_ones{"IIP", "IOP", "SVP"};

std::uint16_t u16_at(ByteView bytes, std::size_t at) {
    return wire::load<wire::ByteOrder::little, std::uint16_t>(bytes.data() + at);
}

class Kmall final : public Recording {
  public:
    void look(const Heard& heard) override {
        for (std::size_t i = 0; i < first_ones.size(); ++i)
            if (heard.name == first_ones[i] && first_[i].empty())
                first_[i].assign(heard.bytes.begin(), heard.bytes.end());
    }

    void begin(std::ostream& out) override {
        for (const Bytes& datagram : first_) put(out, datagram);
        for (const Bytes& datagram : first_) count_ += datagram.empty() ? 0 : 1;
    }

    void add(const Heard& heard, std::ostream& out) override {
        if (heard.name.ends_with(" part")) return add_part(heard.bytes, out);
        const bool is_datagram = heard.bytes.size() >= header_bytes + tail_bytes && heard.bytes[4] == '#';
        if (!is_datagram) return;  // a controller's text
        for (std::size_t i = 0; i < first_ones.size(); ++i)
            if (heard.name == first_ones[i] && !std::exchange(written_[i], true)) return;
        put(out, heard.bytes);
        ++count_;
    }

    void end(std::ostream&) override { drop(); }

  private:
    /// Parts of one datagram have its header, come in order, and the first begins with the body.
    void add_part(ByteView part, std::ostream& out) {
        const std::uint16_t parts = u16_at(part, header_bytes), number = u16_at(part, header_bytes + 2);
        const bool begins = number == 1;
        const bool goes_on = !joined_.empty() && number == next_ && same_ping(part);
        if (!begins && !goes_on) return drop();
        if (begins) {
            drop();
            joined_.assign(part.begin(), part.begin() + header_bytes + partition_bytes);
        }
        joined_.insert(joined_.end(), part.begin() + header_bytes + partition_bytes, part.end() - tail_bytes);
        next_ = static_cast<std::uint16_t>(number + 1);
        if (number < parts) return;
        const auto size = static_cast<std::uint32_t>(joined_.size() + tail_bytes);
        wire::store<wire::ByteOrder::little>(size, joined_.data());
        wire::store<wire::ByteOrder::little>(std::uint16_t{1}, joined_.data() + header_bytes);
        wire::store<wire::ByteOrder::little>(std::uint16_t{1}, joined_.data() + header_bytes + 2);
        joined_.resize(size);
        wire::store<wire::ByteOrder::little>(size, joined_.data() + size - tail_bytes);
        put(out, joined_);
        ++count_;
        joined_.clear();
    }

    /// Type and time.
    bool same_ping(ByteView part) const {
        return std::equal(part.begin() + 4, part.begin() + header_bytes, joined_.begin() + 4);
    }

    void drop() {
        lost_ += joined_.empty() ? 0 : 1;
        joined_.clear();
    }

    std::array<Bytes, 3> first_;
    std::array<bool, 3> written_{};
    Bytes joined_;
    std::uint16_t next_ = 0;
};

}  // namespace

std::unique_ptr<Recording> make_kmall() { return std::make_unique<Kmall>(); }

}  // namespace echoloop::convert
