// libFuzzer: any bytes of a driver to a player that answers as a capture does, which is made of them, too.
// The first byte names the family.
#include <cstddef>
#include <cstdint>

#include "emulator/replay/answering.h"

using namespace echoloop;
using namespace echoloop::replay;

namespace {

/// Both sides of a conversation, the bytes cut as the fuzzer says.
class MadeUp final : public Source {
  public:
    MadeUp(const inspect::Family* family, ByteView bytes) : family_(family), bytes_(bytes) {}

    std::optional<Said> next() override {
        if (bytes_.size() < 2) return {};
        Said said{Time(time_ += 1'000'000LL * bytes_[0]), 0, bytes_[0] % 2 == 0, {}, "", {}};
        const ByteView rest = bytes_.subspan(2);
        const ByteView part = rest.first(std::min<std::size_t>(bytes_[1], rest.size()));
        bytes_ = rest.subspan(part.size());
        MessageReader(family_, true).add(part, [&said](const WholeMessage& message) {
            said.bytes.assign(message.bytes.begin(), message.bytes.end());
            said.name = message.name;
            said.command = message.command;
        });
        return said;
    }
    void rewind() override {}

  private:
    const inspect::Family* family_;
    ByteView bytes_;
    std::int64_t time_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const auto families = inspect::families();
    const std::size_t choice = data[0] % (families.size() + 1);
    const auto* family = choice < families.size() ? &families[choice] : nullptr;
    const ByteView bytes(data + 1, size - 1);
    MadeUp source(family, bytes);
    AnsweringPlayer player(source, {{family, data[0] >= 128}}, 1);
    player.arrived(Time(0));
    player.heard(0, bytes, Time(1000));
    player.heard(0, bytes, Time(2000));
    for (int i = 0; i < 100 && player.due(); ++i) player.take();
    player.reconnected(0);
    return 0;
}
