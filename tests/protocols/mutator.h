// libFuzzer's custom mutator for all that reads messages of a known family: picks one message among the
// bytes, changes a field where the field tables say that it stands, or puts in a message made from a table,
// and then puts lengths, counts and the checksum right, mostly. So made-up bytes get past framers. One line
// in a target:
//     ECHOLOOP_MUTATOR({.family = "ping", .before = 1})
#pragma once

#include "tests/protocols/made_message.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace echoloop::fuzz {

/// What a target's input is.
struct Shape {
    std::string_view family{};  ///< "": of whichever family the bytes are
    std::size_t before = 0;     ///< bytes before the messages
};

/// As LLVMFuzzerMutate: changes `size` bytes in a place that holds `most`, returns how many they are then.
using Plain = std::size_t (*)(std::uint8_t* data, std::size_t size, std::size_t most);

inline Bytes plain(Plain mutate, ByteView bytes, std::size_t most) {
    Bytes changed(bytes.begin(), bytes.end());
    changed.resize(std::max(most, changed.size()));
    changed.resize(mutate(changed.data(), bytes.size(), changed.size()));
    return changed;
}

class Mutator {
  public:
    Mutator(const inspect::Family& family, Random& random, Plain plain)
        : family_(family), random_(random), plain_(plain) {}

    /// Messages, noise between them, or nothing, to `most` bytes that differ.
    Bytes operator()(ByteView bytes, std::size_t most) {
        Bytes out(bytes.begin(), bytes.end());
        const auto messages = family_.decode(bytes);
        std::vector<const inspect::Message*> named;
        for (const auto& message : messages)
            if (!message.name.empty()) named.push_back(&message);
        if (named.empty() && !bytes.empty() && random_() % 4 != 0)
            return plain(plain_, bytes, most);  // e.g. texts
        if (named.empty() || random_() % 8 == 0) {
            const std::size_t at = messages.empty() ? 0 : messages[below(random_, messages.size())].offset;
            const Bytes made = MadeMessage(family_, random_).any();
            out.insert(out.begin() + static_cast<std::ptrdiff_t>(at), made.begin(), made.end());
        } else {
            const inspect::Message& old = *named[below(random_, named.size())];
            const Bytes changed = change(old, bytes.subspan(old.offset, old.size), most);
            const auto from = out.begin() + static_cast<std::ptrdiff_t>(old.offset);
            out.insert(out.erase(from, from + static_cast<std::ptrdiff_t>(old.size)), changed.begin(),
                       changed.end());
        }
        if (out.size() > most) out.resize(most);
        return out;
    }

  private:
    Bytes change(const inspect::Message& old, ByteView bytes, std::size_t most) {
        Bytes message(bytes.begin(), bytes.end());
        std::vector<const Length*> right;  // a message may lie on purpose
        for (const Length& length : lengths)
            if (length.family == family_.name && is_right(length, bytes)) right.push_back(&length);
        for (int changes = 1 + static_cast<int>(random_() % 3); changes > 0; --changes)
            change_once(old, message, most);
        if (random_() % 16 != 0)
            for (const Length* length : right) set(*length, message);
        if (random_() % 16 != 0) set_checksum(family_.name, message);
        if (random_() % 16 == 0)
            message.insert(message.end(), bytes.begin(), bytes.end());  // and once more as it was
        return message;
    }

    /// `message` is `old`, or that changed already: its fields may stand elsewhere then.
    void change_once(const inspect::Message& old, Bytes& message, std::size_t most) {
        if (old.fields.empty() || random_() % 8 == 0) {
            message = plain(plain_, message, most);
            return;
        }
        const inspect::Field& field = old.fields[below(random_, old.fields.size())];
        const std::size_t at = field.offset - old.offset;
        if (at + field.size > message.size()) return;
        if (field.numbers.size() > 1 && random_() % 2 == 0) return change_count(old, field, message);
        if (is_text(old)) return change_text(at, field.size, message);
        if (field.size == 0) return;
        const std::size_t element = field.numbers.empty() ? field.size : field.size / field.numbers.size();
        const std::size_t width =
            element <= 8 ? std::max<std::size_t>(element, 1) : std::size_t{1} << random_() % 4;
        if (width > field.size) return;
        const std::size_t place = at + below(random_, field.size / width) * width;
        const ByteOrder order = random_() % 2 == 0 ? ByteOrder::little : ByteOrder::big;
        const std::uint64_t value = random_() % 4 != 0
                                        ? edge(random_, width)
                                        : get(message.data() + place, width, order) + random_() % 5 - 2;
        put(message.data() + place, width, order, value);
    }

    /// More or fewer elements of an array, and mostly of its counts.
    void change_count(const inspect::Message& old, const inspect::Field& array, Bytes& message) {
        const std::size_t count = array.numbers.size(), element = array.size / count;
        if (element == 0) return;
        const std::size_t choices[] = {0, 1, count - 1, count + 1, 2 * count, below(random_, 300)};
        const std::size_t wanted = choices[below(random_, std::size(choices))];
        const bool honest = random_() % 4 != 0;
        for (const inspect::Field& field : old.fields) {
            const bool counts =
                field.number == static_cast<double>(count) && field.size <= 4 && field.offset < array.offset;
            if (!counts || !honest) continue;
            const ByteOrder order = family_.name == "r2sonic" ? ByteOrder::big : ByteOrder::little;
            put(message.data() + (field.offset - old.offset), field.size, order, wanted);
        }
        const auto end =
            message.begin() + static_cast<std::ptrdiff_t>(array.offset - old.offset + array.size);
        if (wanted > count) message.insert(end, (wanted - count) * element, 0x55);
        if (wanted < count) message.erase(end - static_cast<std::ptrdiff_t>((count - wanted) * element), end);
    }

    bool is_text(const inspect::Message& message) const {
        return family_.name == "nmea" || family_.name == "altimeter" ||
               (family_.name == "waterlinked" && message.name != "PD4");
    }
    void change_text(std::size_t at, std::size_t size, Bytes& message) {
        constexpr std::string_view words[] = {
            "",  "0", "-1",    "1e999", "nan",  "99999999999999999999", "0.0", "-0.", "+1",
            ",", "*", "1.2.3", "true",  "null", "\"get_config\"",       "[]",  "{}"};
        const auto from = message.begin() + static_cast<std::ptrdiff_t>(at);
        const std::string_view word = words[below(random_, std::size(words))];
        message.insert(message.erase(from, from + static_cast<std::ptrdiff_t>(size)), word.begin(),
                       word.end());
    }

    const inspect::Family& family_;
    Random& random_;
    Plain plain_;
};

/// The messages behind `shape.before` bytes, or in every other case all bytes in libFuzzer's own way.
inline Bytes mutated(ByteView input, std::size_t most, unsigned seed, const Shape& shape, Plain mutate) {
    Random random(seed);
    const auto* family = shape.family.empty() && input.size() > shape.before
                             ? inspect::guess_family(input.subspan(shape.before))
                             : inspect::find_family(shape.family);
    if (family == nullptr && shape.family.empty())
        family = &inspect::families()[below(random, inspect::families().size())];
    if (random() % 2 == 0 || input.size() < shape.before || most <= shape.before || family == nullptr)
        return plain(mutate, input, most);
    const Bytes changed = Mutator(*family, random, mutate)(input.subspan(shape.before), most - shape.before);
    Bytes out(input.begin(), input.begin() + static_cast<std::ptrdiff_t>(shape.before));
    out.insert(out.end(), changed.begin(), changed.end());
    return out;
}

/// An input of records {heading of `heading` bytes, length, bytes} behind `before` bytes: one of them is
/// changed as a message of the family, or said again, or a new one comes in.
inline Bytes mutated_records(ByteView input, std::size_t most, unsigned seed, const Shape& shape,
                             std::size_t heading, Plain mutate) {
    constexpr std::size_t longest = 255;
    Random random(seed);
    const auto* family = inspect::find_family(shape.family);
    if (random() % 2 == 0 || input.size() < shape.before || family == nullptr)
        return plain(mutate, input, most);
    std::vector<std::size_t> starts;
    for (std::size_t at = shape.before; at + heading < input.size(); at += heading + 1 + input[at + heading])
        starts.push_back(at);
    const std::size_t at = starts.empty() ? input.size() : starts[below(random, starts.size())];
    const bool fresh = starts.empty() || random() % 3 == 0;
    Bytes record(heading + 1);
    ByteView content;
    if (!fresh) {
        const std::size_t size = std::min<std::size_t>(input[at + heading], input.size() - at - heading - 1);
        std::copy_n(input.begin() + static_cast<std::ptrdiff_t>(at), heading, record.begin());
        content = input.subspan(at + heading + 1, size);
    }
    for (std::size_t i = 0; i < heading; ++i)
        if (fresh || random() % 8 == 0)
            record[i] = static_cast<std::uint8_t>(random() % (random() % 4 == 0 ? 256 : 4));
    Bytes message = Mutator(*family, random, mutate)(content, longest);
    record[heading] = static_cast<std::uint8_t>(message.size());
    record.insert(record.end(), message.begin(), message.end());
    Bytes out(input.begin(), input.begin() + static_cast<std::ptrdiff_t>(at));
    out.insert(out.end(), record.begin(), record.end());
    const std::size_t skipped = fresh || random() % 4 == 0 ? 0 : heading + 1 + content.size();
    const ByteView rest = input.subspan(std::min(input.size(), at + skipped));
    out.insert(out.end(), rest.begin(), rest.end());
    if (out.size() > most) out.resize(most);
    return out;
}

}  // namespace echoloop::fuzz

#define ECHOLOOP_MUTATOR(...)                                                                              \
    extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, \
                                                   unsigned seed) {                                        \
        const auto out = echoloop::fuzz::mutated({data, size}, most, seed, __VA_ARGS__, LLVMFuzzerMutate); \
        std::copy_n(out.begin(), std::min(out.size(), most), data);                                        \
        return std::min(out.size(), most);                                                                 \
    }
