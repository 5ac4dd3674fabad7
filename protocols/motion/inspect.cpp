#include "protocols/motion/inspect.h"

#include <array>
#include <cstdio>

#include "protocols/inspect_stream.h"
#include "protocols/motion/reading.h"

namespace echoloop::motion {
namespace {

/// One number of a message: where it stands and which it is.
struct Row {
    std::string_view name, unit;
    std::size_t offset, size;
    double Reading::*value;
    const char *format, *help;
};

constexpr std::array tss1_rows{
    Row{"horizontal", "m/s^2", 1, 2, &Reading::horizontal, "%.4f", "acceleration, in steps of 3.83 cm/s^2"},
    Row{"vertical", "m/s^2", 3, 4, &Reading::vertical, "%.6f",
        "acceleration upwards, in steps of 0.0625 cm/s^2, two's complement"},
    Row{"heave", "m", 8, 5, &Reading::heave, "%.2f", "up; blank or minus, then centimetres"},
    Row{"roll", "deg", 14, 5, &Reading::roll, "%.2f",
        "port up, against the horizon; blank or minus, then hundredths"},
    Row{"pitch", "deg", 20, 5, &Reading::pitch, "%.2f", "bow up; blank or minus, then hundredths"},
};
constexpr std::array em3000_rows{
    Row{"roll", "deg", 2, 2, &Reading::roll, "%.2f", "port up, in hundredths; to 179.99"},
    Row{"pitch", "deg", 4, 2, &Reading::pitch, "%.2f", "bow up, in hundredths; to 179.99"},
    Row{"heave", "m", 6, 2, &Reading::heave, "%.2f", "up, in hundredths; to 9.99"},
    Row{"heading", "deg", 8, 2, &Reading::heading, "%.2f", "clockwise from north, in hundredths"},
};

std::span<const Row> rows_of(Format format) {
    if (format == Format::tss1) return tss1_rows;
    return em3000_rows;
}

inspect::Message inspected(const Reading& reading, std::size_t offset, std::size_t size) {
    const bool line = reading.format == Format::tss1;
    inspect::Message out{.offset = offset, .size = size, .name = line ? "Tss1" : "EmAttitude3000"};
    char text[16];
    for (const Row& row : rows_of(reading.format)) {
        const double value = reading.*row.value;
        std::snprintf(text, sizeof text, row.format, value);
        out.fields.push_back({.name = std::string(row.name),
                              .text = text,
                              .unit = std::string(row.unit),
                              .offset = offset + row.offset,
                              .size = row.size,
                              .number = value});
    }
    std::snprintf(text, sizeof text, line ? "%c" : "%u", reading.status);
    out.fields.push_back({.name = "status", .text = text, .offset = offset + (line ? 13 : 0), .size = 1});
    return out;
}

wire::Table table_of(std::string name, std::string help, Format format, std::string_view status_type,
                     std::string_view status_help) {
    wire::Table table{.name = std::move(name), .help = std::move(help), .rows = {}};
    for (const Row& row : rows_of(format))
        table.rows.push_back({.meta = {row.name, row.unit, row.help}, .type = "number"});
    table.rows.push_back({.meta = {"status", "", status_help}, .type = std::string(status_type)});
    return table;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

bool recognise(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    framer.finish();
    std::size_t framed = 0;
    while (const auto reading = framer.next()) {
        if (reading->format == Format::tss1) return true;
        framed += framer.frame_size();
    }
    return framed > 0 && 4 * framed >= 3 * bytes.size();
}

std::vector<wire::Table> tables() {
    return {
        table_of("Tss1", "a line of 27 characters, ':' to CR LF", Format::tss1, "char",
                 "u unaided, g by GPS, h by heading, f by both; in capitals once it has settled"),
        table_of("EmAttitude3000", "ten bytes: status, 90 and four numbers, low byte first", Format::em3000,
                 "u8", "144 valid, to 153 less accurate, to 159 not valid, to 175 at fault")};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    const auto reading = read(bytes);
    return reading ? write(*reading) : wire::Bytes{};
}

}  // namespace echoloop::motion
