#include "tools/view/ticker.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "protocols/http/inspect.h"
#include "tools/view/said_picture.h"

namespace echoloop::view {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_fields = 48, longest_text = 120, shown_bytes = 24;
constexpr std::size_t fewest_said = 16, most_said = 1024;  // numbers
constexpr std::size_t large_said = 8192;                   // levels; of smaller pictures all are shown
constexpr std::size_t most_settings = 500;

std::string cut(const std::string& text) {
    return text.size() <= longest_text ? text : text.substr(0, longest_text) + "...";
}

std::string hexadecimal(ByteView bytes) {
    constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (const auto byte : bytes.first(std::min(bytes.size(), shown_bytes))) {
        const auto value = static_cast<unsigned>(byte);
        text += {digits[value >> 4], digits[value & 15], ' '};
    }
    return text + (bytes.size() > shown_bytes ? "..." : "");
}

Json fields_of(const inspect::Message& message) {
    Json fields = Json::array();
    for (const inspect::Field& field : message.fields) {
        if (fields.size() == most_fields) {
            fields.push_back(
                {"...", std::to_string(message.fields.size() - most_fields) + " more fields", ""});
            break;
        }
        fields.push_back({field.name, cut(field.text), field.unit});
    }
    return fields;
}

/// Of the longest array; nothing where there is none that is worth a picture.
std::optional<Json> said_of(const std::string& device, const inspect::Message& message) {
    const auto longest = std::ranges::max_element(
        message.fields, {}, [](const inspect::Field& field) { return field.numbers.size(); });
    if (longest == message.fields.end() || longest->numbers.size() < fewest_said) return std::nullopt;
    const std::size_t every = (longest->numbers.size() + most_said - 1) / most_said;
    Json numbers = Json::array();
    for (std::size_t i = 0; i < longest->numbers.size(); i += every) numbers.push_back(longest->numbers[i]);
    return Json{{"device", device},
                {"name", message.name + "." + longest->name},
                {"unit", longest->unit},
                {"numbers", std::move(numbers)}};
}

/// Names of the fields of `now` that stand otherwise in `before`, or not at
/// all.
Json changed_fields(const Json& now, const Json& before) {
    Json names = Json::array();
    for (const Json& field : now)
        if (std::ranges::find(before, field) == before.end()) names.push_back(field[0]);
    return names;
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

/// What one call of take() tells.
struct Ticker::Batch {
    Json rows = Json::array();
    std::map<std::string, Json> said{}, set{};  ///< by device and message: the last
    /// The same, of pictures that are worth no more than a look.
    struct Large {
        said::Picture picture;
        std::string device;
        std::uint64_t number;
        double unix_time;
    };
    std::map<std::string, Large> large_pictures{};
    std::map<std::string, std::size_t> last_row{};  ///< by way and name: place in `rows`
    std::vector<std::string> pictures{};
    bool sparing = false;
    const std::function<bool(const std::string& device)>* shown = nullptr;
};

Ticker::Told Ticker::take(const std::vector<Passed>& passed, const std::vector<bag::Fault>& faults,
                          std::size_t left_out, bool sparing,
                          const std::function<bool(const std::string& device)>& shown) {
    if (passed.empty() && faults.empty() && left_out == 0) return {};
    Batch batch;
    batch.sparing = sparing, batch.shown = &shown;
    for (const Passed& one : passed) decode(one, batch);
    for (const bag::Fault& one : faults) mark(one, batch.rows);
    Json all{{"type", "messages"},
             {"left_out", left_out},
             {"messages", std::move(batch.rows)},
             {"said", Json::array()},
             {"set", Json::array()}};
    for (auto& [key, numbers] : batch.said) all["said"].push_back(std::move(numbers));
    for (auto& [key, setting] : batch.set) all["set"].push_back(std::move(setting));
    for (const auto& [key, large] : batch.large_pictures)
        batch.pictures.push_back(
            view::message_of(large.picture, large.device, large.number, large.unix_time));
    return {text_of(all), std::move(batch.pictures)};
}

std::string Ticker::settings() const {
    Json all{{"type", "messages"},
             {"left_out", 0},
             {"messages", Json::array()},
             {"said", Json::array()},
             {"set", Json::array()}};
    for (const auto& [key, setting] : settings_) all["set"].push_back(setting);
    return text_of(all);
}

/// On the message that it was made on, which has passed just before or is about
/// to; else as a row of its own.
void Ticker::mark(const bag::Fault& fault, Json& rows) {
    Json* nearest = nullptr;
    double least = 0.05;  // s
    for (Json& row : rows) {
        if (!fault.on_message || row["device"] != fault.device || row["port"] != fault.port ||
            row["sent"] != fault.sent)
            continue;
        const double away = std::abs(row["unix"].get<double>() - fault.unix_time);
        if (away > least) continue;
        least = away;
        nearest = &row;
    }
    if (nearest == nullptr) {
        rows.push_back({{"n", ++count_},
                        {"unix", fault.unix_time},
                        {"device", fault.device},
                        {"port", fault.port},
                        {"sent", true},
                        {"size", 0},
                        {"name", "fault"},
                        {"reason", ""},
                        {"bytes", ""},
                        {"fields", Json::array()}});
        nearest = &rows.back();
    }
    const std::string before = nearest->value("fault", std::string());
    if (before.size() < longest_text)
        (*nearest)["fault"] = before.empty() ? fault.text : before + "; " + fault.text;
}

void Ticker::decode(const Passed& one, Batch& batch) {
    const auto found = families_.find(one.device);
    const inspect::Family* family = found == families_.end() ? nullptr : inspect::find_family(found->second);
    const ByteView bytes(one.bytes);
    auto& stream = streams_[{one.device + "\n" + one.port, one.sent}];
    const auto told = [&](const inspect::Family*, const inspect::Message& message, ByteView part) {
        add(one, message, part, part.size(), batch);
    };
    if (one.gap && stream) stream->finish(told);
    if (family == nullptr || one.size > one.bytes.size()) {
        if (stream) stream->finish(told);
        add(one, {.name = family == nullptr ? "bytes" : "a long message"}, bytes, one.size, batch);
    } else if (one.packets ||
               (family->framing == inspect::Framing::datagram && !stream && !echoloop::http::begins(bytes))) {
        for (const auto& message : family->decode(bytes))
            add(one, message, bytes.subspan(message.offset, message.size), message.size, batch);
    } else {
        if (!stream) stream = std::make_unique<inspect::StreamDecoder>(family);
        stream->add(bytes, told);
    }
}

void Ticker::add(const Passed& one, const inspect::Message& message, ByteView bytes, std::size_t size,
                 Batch& batch) {
    if (message.reason.empty()) look_for_picture(one, message, bytes, batch);
    if (is_part(one, message, batch)) return;
    Json row{{"n", ++count_},
             {"unix", one.unix_time},
             {"device", one.device},
             {"port", one.port},
             {"sent", one.sent},
             {"size", size},
             {"name", message.name},
             {"reason", message.reason},
             {"bytes", hexadecimal(bytes)},
             {"fields", fields_of(message)}};
    if (one.unread > 0) row["parts"] = 1 + one.unread;
    if (!one.sent && message.reason.empty() && !message.name.empty()) note_setting(one, row, batch);
    batch.rows.push_back(std::move(row));
    const auto maker = makers_.find(one.device);
    if (!one.sent || (maker != makers_.end() && maker->second)) return;
    if (auto numbers = said_of(one.device, message))
        batch.said[one.device + "\n" + message.name] = std::move(*numbers);
}

/// The parts of one picture come as many messages in a few milliseconds: they
/// share a row.
bool Ticker::is_part(const Passed& one, const inspect::Message& message, Batch& batch) {
    if (!one.sent || !message.reason.empty()) return false;
    constexpr double together = 0.01;  // s
    const auto [last, first] =
        batch.last_row.try_emplace(one.device + "\n" + one.port + "\n" + message.name, batch.rows.size());
    if (first) return false;
    Json& row = batch.rows[last->second];
    if (one.unix_time - row["unix"].get<double>() > together) {
        last->second = batch.rows.size();
        return false;
    }
    row["parts"] = row.value("parts", 1) + 1;
    return true;
}

void Ticker::note_setting(const Passed& one, const Json& row, Batch& batch) {
    const std::string key = one.device + "\n" + row["name"].get<std::string>();
    const auto before = settings_.find(key);
    if (before == settings_.end() && settings_.size() >= most_settings) return;
    const bool known = before != settings_.end();
    Json setting{
        {"device", one.device},
        {"name", row["name"]},
        {"unix", one.unix_time},
        {"times", known ? before->second["times"].get<std::uint64_t>() + 1 : 1},
        {"fields", row["fields"]},
        {"changed", known ? changed_fields(row["fields"], before->second["fields"]) : Json::array()}};
    settings_[key] = setting;
    batch.set[key] = std::move(setting);
}

void Ticker::look_for_picture(const Passed& one, const inspect::Message& message, ByteView bytes,
                              Batch& batch) {
    const auto family = families_.find(one.device);
    if (family == families_.end()) return;
    const auto [maker, first] = makers_.try_emplace(one.device);
    if (first) maker->second = said::maker_of(family->second);
    if (!maker->second) return;
    // Of a message that makes large pictures nothing is read until the next is
    // wanted.
    constexpr double most_ahead = 2;  // s
    const std::string key = one.device + "\n" + message.name;
    const auto known = rests_.find(key);
    Rest* rest = known == rests_.end() ? nullptr : &known->second;
    if (rest != nullptr && one.unix_time < rest->next && one.unix_time > rest->next - most_ahead) {
        rest->skipped = true;
        rest->in_parts = false;
        return;
    }
    if (rest != nullptr && rest->skipped && !rest->in_parts) maker->second->skipped(message.name);
    auto picture = maker->second->take(message, bytes, one.sent);
    if (!picture) {
        if (rest != nullptr) rest->in_parts = rest->skipped;
        return;
    }
    // The first of several parts may have been skipped, and the next picture is whole.
    if (rest != nullptr && std::exchange(rest->skipped, false) && std::exchange(rest->in_parts, false)) {
        rest->known.insert(picture->name);
        return;
    }
    for (; picture; picture = maker->second->also()) show(one, key, std::move(*picture), batch);
}

/// `key`: of the message in `rests_`.
void Ticker::show(const Passed& one, const std::string& key, said::Picture picture, Batch& batch) {
    constexpr double between_unseen = 1;  // s
    const std::uint64_t number = ++pictures_[one.device];
    if (picture.levels.size() + picture.ranges.size() < large_said) {
        batch.pictures.push_back(view::message_of(picture, one.device, number, one.unix_time));
        return;
    }
    Rest& rest = rests_[key];
    rest.known.insert(picture.name);
    const bool again = !rest.told.insert(picture.name).second;
    if (!batch.sparing && (*batch.shown)(one.device))
        rest.next = 0, rest.told.clear();
    else if (again || rest.told == rest.known)
        rest.next = one.unix_time + between_unseen, rest.told.clear();
    const std::string kind = one.device + "\n" + picture.name;  // before the picture is moved
    batch.large_pictures[kind] = {std::move(picture), one.device, number, one.unix_time};
}

}  // namespace echoloop::view
