#include "protocols/checksums.h"

#include "protocols/inspect.h"

namespace echoloop {

FindChecksums find_checksums(std::string_view family) {
    const inspect::Family* row = inspect::find_family(family);
    return row == nullptr ? nullptr : row->checksums;
}

}  // namespace echoloop
