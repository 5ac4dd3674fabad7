#include <algorithm>

#include "protocols/kmall/codec.h"
#include "tools/capture/little_endian.h"
#include "tools/capture/makers_files.h"

namespace echoloop::capture {
namespace {

constexpr std::size_t kmall_header = 20, kmall_tail = 4;
/// Room for a water column of 1024 beams with phases; more is no size.
constexpr std::size_t kmall_longest = std::size_t{16} << 20;

enum class KmallBegin { no, cut, yes };

/// Whether a datagram kmall_begins here: by its mark, and by the size that stands again at its end.
KmallBegin kmall_begins(ByteView bytes) {
    constexpr std::size_t mark = 8;
    if (bytes.size() < mark) return KmallBegin::cut;
    const auto is_capital = [](std::uint8_t c) { return c >= 'A' && c <= 'Z'; };
    if (bytes[4] != '#' || !std::all_of(bytes.begin() + 5, bytes.begin() + 8, is_capital))
        return KmallBegin::no;
    const std::size_t size = little::u32(bytes, 0);
    if (size < kmall_header + kmall_tail || size > kmall_longest) return KmallBegin::no;
    if (size > bytes.size()) return KmallBegin::cut;
    return little::u32(bytes, size - kmall_tail) == size ? KmallBegin::yes : KmallBegin::no;
}

class KmallFile final : public Container {
  public:
    explicit KmallFile(bool in_parts) : in_parts_(in_parts) {}

    Entry look(ByteView pending, bool last) override {
        const KmallBegin begin = kmall_begins(pending);
        if (begin == KmallBegin::cut && !last) return {};
        if (begin != KmallBegin::yes) {
            const auto may_begin = [last](ByteView rest) {
                const KmallBegin found = kmall_begins(rest);
                return found == KmallBegin::yes ||
                       (found == KmallBegin::cut && rest.size() >= kmall_header && !last);
            };
            return {.size = distance_to_next(pending, last, kmall_header, may_begin), .damaged = true};
        }
        Entry entry{.size = little::u32(pending, 0)};
        const ByteView bytes = pending.first(entry.size);
        entry.time = little::u32(bytes, 12) + little::u32(bytes, 16) * 1e-9;
        entry.clock.assign(bytes.begin() + 4, bytes.begin() + 8);
        Bytes datagram(bytes.begin(), bytes.end());
        if (in_parts_)
            entry.said = kmall::divided(std::move(datagram));
        else
            entry.said.push_back(std::move(datagram));
        return entry;
    }

  private:
    bool in_parts_;
};

}  // namespace

std::unique_ptr<CaptureReader> open_kmall(Input& input, const OpenSettings& settings) {
    const Bytes& start = input.peek(kmall_header + kmall_tail);
    if (start.size() < kmall_header + kmall_tail || !kmall::recognise(start) || start[0] == '$')
        return nullptr;
    return std::make_unique<ContainerFile>(input, std::make_unique<KmallFile>(settings.as_sent), "kmall",
                                           ContainerFile::Speech::datagrams);
}

}  // namespace echoloop::capture
