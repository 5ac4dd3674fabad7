#include "emulator/scenario/fault_kinds.h"

#include <algorithm>
#include <utility>

namespace echoloop {
namespace {

/// `low` and `high` are inclusive.
Option parameter(std::string name, std::string unit, OptionValue value, double low, double high,
                 std::string help) {
    return {std::move(name), std::move(unit), std::move(value), std::move(help), "", {}, low, high};
}

Option chance(double value, const std::string& of) {
    return parameter("rate", "", value, 0, 1, "share of " + of + " that are affected");
}

Option seconds(std::string name, double value, double low, double high, std::string help) {
    return parameter(std::move(name), "s", value, low, high, std::move(help));
}

Option count(std::string name, std::int64_t value, double low, double high, std::string help) {
    return parameter(std::move(name), "", value, low, high, std::move(help));
}

Option patience() {
    return seconds("within", 0.5, 0, 60, "a message waits no longer than this for the next ones");
}

std::vector<FaultRow> rows_of_bytes() {
    using Kind = FaultKind;
    constexpr auto bytes = FaultRow::Where::bytes;
    return {
        {Kind::loss, "loss", bytes, "whole messages are lost", {chance(0.01, "messages")}},
        {Kind::silence, "silence", bytes, "nothing is sent; the device carries on"},
        {Kind::duplication,
         "duplication",
         bytes,
         "messages come more than once",
         {chance(0.01, "messages"), count("copies", 1, 1, 100, "how many copies follow")}},
        {Kind::wrong_checksum,
         "wrong_checksum",
         bytes,
         "the checksum of a message is wrong and everything else is right",
         {chance(0.01, "messages")},
         "a protocol with checksums"},
        {Kind::truncation,
         "truncation",
         bytes,
         "the end of a message is missing",
         {chance(0.01, "messages"),
          count("keep", 0, 0, 1 << 20, "bytes that are kept; 0: any number, but at least one is cut off")}},
        {Kind::bit_flips,
         "bit_flips",
         bytes,
         "single bits are inverted, at most one in a byte",
         {chance(1e-4, "bits")}},
        {Kind::merge,
         "merge",
         bytes,
         "messages are merged into one write or datagram",
         {count("messages", 2, 2, 1000, "how many become one"), patience()}},
        {Kind::reordering,
         "reordering",
         bytes,
         "a message comes after those that should follow it",
         {chance(0.01, "messages"), count("by", 1, 1, 1000, "messages that overtake it"), patience()}},
        {Kind::split,
         "split",
         bytes,
         "messages come in parts, cut at any place; each part is a write or datagram of its own",
         {chance(1, "messages"), count("parts", 2, 2, 1000, "into how many"),
          seconds("gap", 0.005, 0, 60, "pause between the parts")}},
    };
}

std::vector<FaultRow> rows_of_time() {
    using Kind = FaultKind;
    constexpr auto bytes = FaultRow::Where::bytes;
    FaultRow stale{Kind::stale_burst, "stale_burst", bytes,
                   "messages are held back until the fault ends and then come all at once"};
    stale.needs_end = true;
    return {
        {Kind::latency,
         "latency",
         bytes,
         "messages come late",
         {seconds("delay", 0.1, 0, 60, "how late each comes")}},
        {Kind::jitter,
         "jitter",
         bytes,
         "messages come late by varying times, in their order",
         {seconds("delay", 0.02, 0, 60, "the largest delay; all delays from 0 up to it are equally likely")}},
        {Kind::bandwidth,
         "bandwidth",
         bytes,
         "the line carries at most this many bits a second; messages queue up",
         {parameter("bits_per_second", "bit/s", 9600.0, 1, 1e12, "what the line carries")}},
        std::move(stale)};
}

std::vector<FaultRow> rows_of_lines_and_devices() {
    using Kind = FaultKind;
    using Where = FaultRow::Where;
    return {
        {Kind::baud_mismatch,
         "baud_mismatch",
         Where::bytes,
         "the device's UART runs at another rate than the driver's, and the garbage that a UART makes of it "
         "arrives",
         {parameter("baud", "bit/s", 9600.0, 50, 1e7, "rate at which the device speaks and listens")},
         "a serial line"},
        {Kind::unplug, "unplug", Where::line,
         "the cable is pulled: a pty hangs up and its link goes, TCP is closed and refused, UDP and serial "
         "ports are dead; when the fault ends, it is put back"},
        {Kind::half_open,
         "half_open",
         Where::line,
         "the device has silently forgotten the TCP connection; when the fault ends, the old connection is "
         "reset",
         {},
         "a TCP port"},
        {Kind::reset, "reset", Where::line, "the TCP connection is reset", {}, "a TCP port", true},
        {Kind::reboot,
         "reboot",
         Where::device,
         "the device loses power and restarts without anything it was told before",
         {seconds("off", 0, 0, 3600, "time without power")},
         {},
         true},
        {Kind::stuck_motor,
         "stuck_motor",
         Where::device,
         "the head stops turning while the device says that it turns",
         {},
         "a motor"},
        {Kind::frozen_image, "frozen_image", Where::device, "every ping hears the same echoes again"},
        {Kind::bad_numbers,
         "bad_numbers",
         Where::bytes,
         "a number in a line of text has a sign before its decimals too, -1.-4, and the checksum fits, as "
         "faulty "
         "firmware writes it",
         {chance(0.01, "messages")},
         "lines of text"},
    };
}

}  // namespace

std::span<const FaultRow> fault_table() {
    static const std::vector<FaultRow> table = [] {
        auto rows = rows_of_bytes();
        for (auto& more : {rows_of_time(), rows_of_lines_and_devices()})
            rows.insert(rows.end(), more.begin(), more.end());
        return rows;
    }();
    return table;
}

const FaultRow* find_fault(std::string_view name) {
    const auto table = fault_table();
    const auto found = std::ranges::find(table, name, &FaultRow::name);
    return found == table.end() ? nullptr : &*found;
}

}  // namespace echoloop
