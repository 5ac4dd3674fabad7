// libFuzzer: any bytes as messages whose checksums somebody wants to find; the first byte chooses the family.
// Every place must lie inside the bytes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "protocols/checksums.h"
#include "protocols/inspect.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace echoloop;
    if (size == 0) return 0;
    const auto families = inspect::families();
    const auto find = find_checksums(families[data[0] % families.size()].name);
    if (find == nullptr) return 0;
    const wire::ByteView bytes(data + 1, size - 1);
    for (const ChecksumPlace& place : find(bytes))
        if (place.size == 0 || place.offset > bytes.size() || place.size > bytes.size() - place.offset)
            std::abort();
    return 0;
}
