// The table of faults that a run can make: names, parameters with units, bounds and defaults. Rows only;
// makes none.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/contract/model.h"

namespace echoloop {

/// A kind's place is part of what its random numbers are made from: new ones come last.
enum class FaultKind {
    loss,
    silence,
    duplication,
    wrong_checksum,
    truncation,
    bit_flips,
    merge,
    reordering,
    split,
    latency,
    jitter,
    bandwidth,
    stale_burst,
    baud_mismatch,
    unplug,
    half_open,
    reset,
    reboot,
    stuck_motor,
    frozen_image,
    bad_numbers
};
inline constexpr std::size_t fault_kinds = static_cast<std::size_t>(FaultKind::bad_numbers) + 1;

struct FaultRow {
    enum class Where {
        bytes,  ///< what is said: each message on its way, in either direction
        line,   ///< the connection itself
        device  ///< the sonar at its end
    };

    FaultKind kind;
    std::string name;  ///< "bit_flips"
    Where where;
    std::string help;
    std::vector<Option> parameters{};
    std::string needs{};     ///< what a device must have for it, "" if every one has it
    bool momentary = false;  ///< has a time but no length
    bool needs_end = false;  ///< makes no sense without an end
};

/// All kinds in the order of FaultKind.
std::span<const FaultRow> fault_table();
inline const FaultRow& row_of(FaultKind kind) { return fault_table()[static_cast<std::size_t>(kind)]; }
/// nullptr if there is none of that name.
const FaultRow* find_fault(std::string_view name);

}  // namespace echoloop
