#include "protocols/altimeter/inspect.h"

#include "protocols/altimeter/line.h"
#include "protocols/inspect_stream.h"

namespace echoloop::altimeter {
namespace {

inspect::Message inspected(const Reading& reading, std::size_t offset, std::size_t size) {
    const std::string text = write_line(reading);
    inspect::Message out{.offset = offset, .size = size, .name = "Reading"};
    const auto number = [&](std::string name, std::string text_of, const char* unit, std::size_t at,
                            std::size_t length, double value) {
        out.fields.push_back({.name = std::move(name),
                              .text = std::move(text_of),
                              .unit = unit,
                              .offset = offset + at,
                              .size = length,
                              .number = value});
    };
    if (reading.format == Format::time) {
        out.name = "Time";
        number("time", std::to_string(reading.microseconds), "us", 1, 2, reading.microseconds);
        number("level", std::to_string(reading.level), "", 3, 1, reading.level);
        return out;
    }
    const std::size_t from = text.find_first_of("0123456789");
    const std::string digits = text.substr(from, text.find_first_not_of("0123456789.", from) - from);
    const bool millimetres = reading.format == Format::millimetres;
    const bool centimetres = reading.format == Format::centimetres;
    number("range", digits,
           millimetres   ? "mm"
           : centimetres ? "cm"
                         : "m",
           from, digits.size(),
           reading.metres * (millimetres   ? 1000
                             : centimetres ? 100
                                           : 1));
    return out;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

bool recognise(wire::ByteView bytes) {
    Framer framer;
    framer.feed(bytes);
    framer.finish();
    while (const auto reading = framer.next())
        if (is_sure(reading->format)) return true;
    return false;
}

std::vector<wire::Table> tables() {
    const auto row = [](std::string_view name, const char* type, std::string_view unit,
                        std::string_view help) {
        return wire::Row{.meta = {name, unit, help}, .type = type};
    };
    return {{.name = "Reading",
             .help = "one line of text: xxx.xxxm, Axxx.xxxm with the unit's letter, xx.xxxm, xxx.xxm, "
                     "Rxx.xx, x.xxx or "
                     "xxxxx (cm) with CR LF, or whole millimetres, dmm LF",
             .rows = {row("range", "number", "m, mm or cm",
                          "to the bottom; the device's setting says what stands without one"),
                      row("unit", "char[]", "",
                          "m or mm, or none; behind Rxx.xx E without an echo, < below the range"),
                      row("end", "char[]", "", "CR LF, or LF after mm")}},
            {.name = "Time",
             .help = "four bytes: FF, time of flight, level of the echo",
             .rows = {row("start", "u8", "", "FF"),
                      row("time", "u16", "us", "high byte first; there and back, 0: no echo"),
                      row("level", "u8", "", "of the echo")}}};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    const auto reading = read_line(wire::characters(bytes));
    const std::string text = reading ? write_line(*reading) : "";
    return {text.begin(), text.end()};
}

}  // namespace echoloop::altimeter
