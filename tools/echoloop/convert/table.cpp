#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>

#include "emulator/contract/error.h"
#include "emulator/scenario/value.h"
#include "tools/capture/messages.h"
#include "tools/capture/open.h"
#include "tools/capture/ports.h"
#include "tools/echoloop/convert/from_capture.h"
#include "tools/echoloop/diff/side.h"
#include "tools/echoloop/watched_capture.h"

namespace echoloop::convert {
namespace {

constexpr std::size_t most_columns = 5000;

std::string number_of(double value) {
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// Quoted where a comma, a quote or a line's end would break the row.
std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + '"';
}

std::string cell(const diff::Value& value) {
    if (const auto* number = std::get_if<double>(&value)) return number_of(*number);
    if (const auto* text = std::get_if<std::string>(&value)) return cell(*text);
    std::string out;
    for (const double one : std::get<std::vector<double>>(value))
        out += (out.empty() ? "" : " ") + number_of(one);
    return out;
}

struct Row {
    double time = 0;
    std::string direction, name;
    std::vector<diff::NamedValue> fields;
};

std::vector<std::string> for_rows(const Source& source, const std::function<void(const Row&)>& each) {
    capture::Input input(source.file);
    const auto file = std::make_unique<cli::WatchedCapture>(input, capture::open_capture(input));
    std::optional<double> start;
    capture::MessageSorter messages(nullptr, [&](const auto& origin, const auto& message) {
        const bool wanted = source.message.empty() || source.message == message.name;
        if (message.name.empty() || !message.reason.empty() || !wanted) return;
        if (!diff::fits(origin.way, source.line)) return;
        diff::Direction direction;
        direction.ways.push_back(origin.way);
        each({std::round((origin.time - *start) * 1e6) / 1e6, direction.text(), message.name,
              diff::named_values(message)});
    });
    while (const auto event = file->next()) {
        if (!start) start = event->time;
        messages.add(*event);
    }
    messages.finish();
    return capture::troubles(file->counts());
}

}  // namespace

Written write_table(const Source& source, const std::filesystem::path& out) {
    if (source.file == "-")
        throw StartError(Exit::usage, "the capture is read twice; save standard input to a file");
    std::vector<std::string> columns;
    std::map<std::string, std::size_t> places;
    for_rows(source, [&](const Row& row) {
        for (const auto& field : row.fields)
            if (columns.size() < most_columns && places.try_emplace(field.name, columns.size()).second)
                columns.push_back(field.name);
    });
    std::ofstream file(out, std::ios::binary);
    file << "time,direction,message";
    for (const auto& column : columns) file << ',' << cell(column);
    file << '\n';
    Written written;
    written.troubles = for_rows(source, [&](const Row& row) {
        std::vector<std::string> cells(columns.size());
        for (const auto& field : row.fields)
            if (const auto place = places.find(field.name);
                place != places.end() && place->second < cells.size())
                cells[place->second] = cell(field.value);
        file << number_of(row.time) << ',' << cell(row.direction) << ',' << cell(row.name);
        for (const auto& one : cells) file << ',' << one;
        file << '\n';
        ++written.count;
    });
    if (written.count == 0)
        throw StartError(Exit::data, scenario::in_quotes(source.file) + ": no message of a known protocol" +
                                         (source.message.empty() ? "" : " called " + source.message));
    if (!file.flush()) throw std::runtime_error("cannot write all of it");
    return written;
}

}  // namespace echoloop::convert
