// Where the checksums of messages stand, for families that have them: who damages one on purpose leaves all
// else right. Changes nothing.
#pragma once

#include <string_view>
#include <vector>

#include "protocols/wire/bytes.h"

namespace echoloop {

/// Of one message among the bytes given.
struct ChecksumPlace {
    std::size_t offset = 0, size = 0;  ///< bytes
    bool hex_digits = false;           ///< written as hexadecimal digits
    friend bool operator==(const ChecksumPlace&, const ChecksumPlace&) = default;
};

/// Those of all whole messages among `bytes`, which begin with one.
using FindChecksums = std::vector<ChecksumPlace> (*)(wire::ByteView bytes);

/// For a family as `echoloop inspect` names it; nullptr if its messages have no checksum.
FindChecksums find_checksums(std::string_view family);

}  // namespace echoloop
