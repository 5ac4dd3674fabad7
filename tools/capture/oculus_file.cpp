#include <algorithm>
#include <cmath>

#include "emulator/contract/error.h"
#include "emulator/scenario/value.h"
#include "tools/capture/inflate.h"
#include "tools/capture/little_endian.h"
#include "tools/capture/makers_files.h"

namespace echoloop::capture {
namespace {

constexpr std::uint32_t oculus_mark = 0x11223344, item_mark = 0xAABBCCDD;
constexpr std::size_t oculus_header = 48, item_header = 40;
constexpr std::size_t longest_item = std::size_t{16}
                                     << 20;  // B of a message; real images have less than 2 MB
constexpr std::uint16_t sonar_message = 10;  // type: as on TCP

bool is_item(ByteView bytes) {
    return bytes.size() >= item_header && little::u32(bytes, 0) == item_mark &&
           little::u32(bytes, 4) == item_header && little::u32(bytes, 28) <= longest_item &&
           little::u32(bytes, 32) <= longest_item && std::isfinite(little::f64(bytes, 16));
}

class OculusFile final : public Container {
  public:
    Entry look(ByteView pending, bool last) override {
        if (pending.size() < item_header && !last) return {};
        const std::size_t size = is_item(pending) ? item_header + little::u32(pending, 32) : 0;
        if (size > pending.size() && !last) return {};
        if (size == 0 || size > pending.size())
            return {.size = distance_to_next(pending, last, item_header, is_item), .damaged = true};
        const auto lost = lost_bytes_before(pending, size, last, item_header, is_item);
        if (!lost) return {};
        if (*lost > 0) return {.size = *lost, .damaged = true};
        Entry entry{.size = size, .time = little::f64(pending, 16)};
        if (little::u16(pending, 8) != sonar_message) return entry;
        const ByteView payload = pending.subspan(item_header, size - item_header);
        const bool is_compressed = little::u16(pending, 24) == 1;
        auto bytes = is_compressed ? qt_uncompressed(payload, longest_item)
                                   : std::optional<Bytes>(Bytes(payload.begin(), payload.end()));
        if (bytes)
            entry.said.push_back(std::move(*bytes));
        else
            entry.damaged = true;
        return entry;
    }
};

}  // namespace

std::unique_ptr<CaptureReader> open_oculus(Input& input, const OpenSettings&) {
    const Bytes start = input.peek(oculus_header);
    constexpr std::size_t name = 8, encryption = 26;
    if (start.size() < oculus_header || little::u32(start, 0) != oculus_mark ||
        little::u32(start, 4) != oculus_header ||
        !std::ranges::equal(ByteView(start).subspan(name, 6), std::string_view("Oculus")))
        return nullptr;
    if (little::u16(start, encryption) != 0)
        throw StartError(Exit::data,
                         scenario::in_quotes(input.name()) +
                             " is an encrypted Oculus recording; record it again without encryption");
    input.read(oculus_header);
    return std::make_unique<ContainerFile>(input, std::make_unique<OculusFile>(), "oculus",
                                           ContainerFile::Speech::stream, oculus_header);
}

}  // namespace echoloop::capture
