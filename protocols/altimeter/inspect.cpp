#include "protocols/altimeter/inspect.h"

#include "protocols/altimeter/line.h"
#include "protocols/inspect_stream.h"

namespace echoloop::altimeter {
namespace {

inspect::Message inspected(const Reading& reading, std::size_t offset, std::size_t size) {
    const bool millimetres = reading.format == Format::millimetres;
    const std::string text = write_line(reading);
    const std::string number = text.substr(0, text.find('m'));
    inspect::Message out{.offset = offset, .size = size, .name = "Reading"};
    out.fields.push_back({.name = "range",
                          .text = number,
                          .unit = millimetres ? "mm" : "m",
                          .offset = offset,
                          .size = number.size(),
                          .number = reading.metres * (millimetres ? 1000 : 1)});
    return out;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

bool recognise(wire::ByteView bytes) { return inspect::recognise_stream<Framer>(bytes); }

std::vector<wire::Table> tables() {
    const auto row = [](std::string_view name, const char* type, std::string_view unit,
                        std::string_view help) {
        return wire::Row{.meta = {name, unit, help}, .type = type};
    };
    return {
        {.name = "Reading",
         .help = "one line of text: xxx.xxxm CR LF, xxx.xxm CR LF, or whole millimetres, dmm LF",
         .rows = {row("range", "number", "m or mm",
                      "to the bottom; the device's setting says what stands without one"),
                  row("unit", "char[]", "", "m or mm"), row("end", "char[]", "", "CR LF, or LF after mm")}}};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    const auto reading = read_line(wire::characters(bytes));
    const std::string text = reading ? write_line(*reading) : "";
    return {text.begin(), text.end()};
}

}  // namespace echoloop::altimeter
