#include "protocols/kmall/codec.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "protocols/kmall/sizes.h"
#include "protocols/wire/read.h"

namespace echoloop::kmall {
namespace {

using wire::ByteOrder;
using wire::Bytes;
using wire::ByteView;
using wire::Error;
using wire::Reason;
using wire::Result;

static_assert(wire::fixed_size<Header>() == header_size && wire::fixed_size<PingInfo>() == 152);
static_assert(wire::fixed_size<TxSector>() == 48 && wire::fixed_size<RxInfo>() == 32);
static_assert(wire::fixed_size<Sounding>() == 120 && wire::fixed_size<WaterBeamInfo>() == 16);

/// Earlier versions have less of these.
template <class T>
constexpr std::size_t least_size = known_size<T>;
template <>
constexpr std::size_t least_size<PingInfo> = 144;
template <>
constexpr std::size_t least_size<TxSector> = 36;
template <>
constexpr std::size_t least_size<WaterBeamInfo> = 12;

/// Walks through a datagram by the sizes of its structs; what is not there is an error, never read.
class Steps {
  public:
    explicit Steps(ByteView bytes) : bytes_(bytes) {}

    /// A struct of `size` bytes.
    template <class T>
    bool take(T& out, std::size_t size = known_size<T>) {
        const auto name = wire::layout<T>.name;
        if (size < least_size<T>) return fail(name, Reason::wrong_size);
        if (size > left()) return fail(name, Reason::truncated);
        Bytes known(known_size<T>);
        std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), std::min(size, known.size()),
                    known.begin());
        const auto parsed = wire::parse<T>(known);
        if (!parsed) return fail(name, parsed.error().reason);
        out = *parsed;
        at_ += size;
        return true;
    }
    /// A struct whose first field is its size.
    template <class T>
    bool take_sized(T& out) {
        if (left() < 2) return fail(wire::layout<T>.name, Reason::truncated);
        return take(out, wire::load<ByteOrder::little, std::uint16_t>(bytes_.data() + at_));
    }
    template <class T>
    bool take_all(std::vector<T>& out, std::size_t count, std::size_t size) {
        if (count > 0 && size < least_size<T>) return fail(wire::layout<T>.name, Reason::wrong_size);
        if (count * size > left()) return fail(wire::layout<T>.name, Reason::truncated);
        out.resize(count);
        return std::all_of(out.begin(), out.end(), [&](T& one) { return take(one, size); });
    }
    template <class Wire, class T>
    bool take_numbers(std::vector<T>& out, std::size_t count) {
        if (count * sizeof(Wire) > left()) return fail("samples", Reason::truncated);
        out.resize(count);
        for (T& one : out) {
            one = wire::load<ByteOrder::little, Wire>(bytes_.data() + at_);
            at_ += sizeof(Wire);
        }
        return true;
    }
    bool take_text(std::string& out, std::size_t size) {
        if (size > left()) return fail("text", Reason::truncated);
        out.assign(reinterpret_cast<const char*>(bytes_.data()) + at_, size);
        at_ += size;
        return true;
    }
    void take_rest(Bytes& out) {
        out.assign(bytes_.begin() + static_cast<std::ptrdiff_t>(at_), bytes_.end());
        at_ = bytes_.size();
    }
    std::size_t left() const { return bytes_.size() - at_; }
    bool fail(std::string_view what, Reason reason) {
        error = {"KMALL", what, at_, reason};
        return false;
    }

    Error error;

  private:
    ByteView bytes_;
    std::size_t at_ = 0;
};

bool read(Steps& steps, Mrz& m) {
    const auto image_samples = [&] {
        std::size_t sum = 0;
        for (const Sounding& s : m.soundings) sum += s.image_samples;
        return sum;
    };
    return steps.take_sized(m.body) && steps.take_sized(m.ping) &&
           steps.take_all(m.sectors, m.ping.tx_sectors, m.ping.bytes_per_sector) && steps.take_sized(m.rx) &&
           steps.take_all(m.classes, m.rx.classes, m.rx.bytes_per_class) &&
           steps.take_all(m.soundings, std::size_t{m.rx.soundings} + m.rx.extra_detections,
                          m.rx.bytes_per_sounding) &&
           steps.take_numbers<std::int16_t>(m.image, image_samples());
}

bool read_beam(Steps& steps, WaterBeam& beam, const WaterRx& rx) {
    if (!steps.take(beam.info, rx.bytes_per_beam)) return false;
    const std::size_t samples = beam.info.samples;
    if (!steps.take_numbers<std::int8_t>(beam.amplitude, samples)) return false;
    if (rx.phase == 1) return steps.take_numbers<std::int8_t>(beam.phase, samples);
    return rx.phase != 2 || steps.take_numbers<std::int16_t>(beam.phase, samples);
}

bool read(Steps& steps, Mwc& m) {
    if (!steps.take_sized(m.body) || !steps.take_sized(m.tx) ||
        !steps.take_all(m.sectors, m.tx.sectors, m.tx.bytes_per_sector) || !steps.take_sized(m.rx))
        return false;
    if (m.rx.beams * least_size < WaterBeamInfo >> steps.left())
        return steps.fail("WaterBeamInfo", Reason::truncated);
    m.beams.resize(m.rx.beams);
    return std::all_of(m.beams.begin(), m.beams.end(),
                       [&](WaterBeam& beam) { return read_beam(steps, beam, m.rx); });
}

bool read(Steps& steps, Part& part) {
    steps.take_rest(part.bytes);
    return true;
}

bool read(Steps& steps, Parameters& p) {
    if (!steps.take(p.info)) return false;
    if (p.info.size < known_size<ParametersInfo>) return steps.fail("ParametersInfo", Reason::wrong_size);
    if (!steps.take_text(p.text, p.info.size - known_size<ParametersInfo>)) return false;
    if (steps.left() == 1) steps.take_rest(p.surplus);
    return true;
}

bool read(Steps& steps, SoundProfile& p) {
    if (!steps.take_sized(p.info) || !steps.take_all(p.points, p.info.points, known_size<SoundProfilePoint>))
        return false;
    if (steps.left() == known_size<SoundProfilePoint>) steps.take_rest(p.surplus);
    return true;
}

template <class Values>
bool read_values(Steps& steps, Sensor& sensor) {
    return steps.take_sized(sensor.info) && steps.take(sensor.values.emplace<Values>()) &&
           steps.take_text(sensor.text, steps.left());
}

bool read(Steps& steps, Sensor& sensor) {
    const auto type = sensor.header.type.view();
    if (type == "#SPO" || type == "#CPO") return read_values<Position>(steps, sensor);
    if (type == "#SPE") return read_values<PositionError>(steps, sensor);
    if (type == "#SPD") return read_values<Datum>(steps, sensor);
    if (type == "#SCL") return read_values<Clock>(steps, sensor);
    if (type == "#SHI") return read_values<Height>(steps, sensor);
    if (type == "#SSM") return read_values<SoundSpeedManager>(steps, sensor);
    return sensor.header.version == 0 ? read_values<DepthSensor0>(steps, sensor)
                                      : read_values<DepthSensor>(steps, sensor);
}

bool read(Steps& steps, Headings& h) {
    if (!steps.take_sized(h.info) || !steps.take_sized(h.about)) return false;
    const std::size_t known = known_size<HeadingSample>, size = h.about.bytes_per_sample;
    if (h.about.samples > 0 && size < known) return steps.fail("HeadingSample", Reason::wrong_size);
    if (h.about.samples * size > steps.left()) return steps.fail("HeadingSample", Reason::truncated);
    h.samples.resize(h.about.samples);
    h.texts.resize(h.about.samples);
    for (std::size_t i = 0; i < h.samples.size(); ++i)
        if (!steps.take(h.samples[i]) || !steps.take_text(h.texts[i], size - known)) return false;
    return true;
}

template <class M>
bool read_samples(Steps& steps, M& m) {
    return steps.take_sized(m.info) && steps.take_all(m.samples, m.info.samples, m.info.bytes_per_sample);
}
bool read(Steps& steps, SoundSpeeds& m) { return read_samples(steps, m); }
bool read(Steps& steps, Motion& m) { return read_samples(steps, m); }

bool read(Steps& steps, PingHeave& m) { return steps.take_sized(m.body) && steps.take(m.heave); }

bool read(Steps& steps, CalibrationFile& m) {
    if (!steps.take_sized(m.info)) return false;
    steps.take_rest(m.bytes);
    return true;
}

template <class M>
Result<Datagram> read_as(Steps& steps, const Header& header, Partition partition = {}) {
    M message;
    message.header = header;
    if constexpr (requires { message.partition; }) message.partition = partition;
    if (!read(steps, message)) return steps.error;
    if constexpr (!std::is_same_v<M, Part>)
        if (steps.left() != 0) return Error{"KMALL", "", 0, Reason::trailing_bytes};
    return Datagram(std::move(message));
}

bool is_sensor(std::string_view type) {
    constexpr std::array<std::string_view, 8> types{"#SPO", "#CPO", "#SPE", "#SPD",
                                                    "#SCL", "#SDE", "#SHI", "#SSM"};
    return std::ranges::find(types, type) != types.end();
}

/// Texts end where they end, or with a line's end or with padding.
Result<Datagram> read_command(ByteView bytes) {
    static constexpr std::string_view delimiters{",\r\n \0", 5};
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    text.remove_prefix(command_word.size());
    Command command;
    const auto take = [&](unsigned& number) {
        const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (fault != std::errc{}) return false;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        return true;
    };
    if (!take(command.number) || text.empty() || text.front() != ',')
        return Error{"KSSIS", "number", command_word.size(), Reason::wrong_constant};
    text.remove_prefix(1);
    const std::string_view name = text.substr(0, text.find_first_of(delimiters));
    if (name.find('=') != name.npos) {  // "NAME=...", of a sounder that is found
        command.arguments = text;
        return Datagram(std::move(command));
    }
    if (name.empty() || !std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c <= '~'; }))
        return Error{"KSSIS", "sounder", bytes.size() - text.size(), Reason::wrong_constant};
    command.sounder = name;
    command.arguments = text.substr(name.size());
    const bool padded = command.arguments.find_first_not_of(delimiters.substr(1)) == std::string::npos;
    if (!padded && command.arguments.front() != ',')
        return Error{"KSSIS", "sounder", bytes.size() - command.arguments.size(), Reason::wrong_constant};
    return Datagram(std::move(command));
}

bool is_command(ByteView bytes) {
    return bytes.size() >= command_word.size() &&
           std::equal(command_word.begin(), command_word.end(), bytes.begin());
}

/// "$MVS01,00000,": any talker, a format's number.
bool is_sound_text(ByteView bytes) {
    constexpr std::string_view form = "$??S##,00000,";
    return bytes.size() >= form.size() &&
           std::equal(form.begin(), form.end(), bytes.begin(), [](char wanted, std::uint8_t c) {
               return wanted == '?'   ? c >= 'A' && c <= 'Z'
                      : wanted == '#' ? c >= '0' && c <= '9'
                                      : c == wanted;
           });
}

bool is_text(ByteView bytes) { return is_command(bytes) || is_sound_text(bytes); }

}  // namespace

bool recognise(ByteView bytes) {
    const auto is_capital = [](std::uint8_t c) { return c >= 'A' && c <= 'Z'; };
    return is_text(bytes) || (bytes.size() >= header_size + tail_size && bytes[4] == '#' &&
                              std::all_of(bytes.begin() + 5, bytes.begin() + 8, is_capital));
}

std::size_t datagram_size(ByteView bytes) {
    if (is_text(bytes) || !recognise(bytes)) return bytes.size();
    const std::size_t size = wire::load<ByteOrder::little, std::uint32_t>(bytes.data());
    return size >= header_size + tail_size && size < bytes.size() ? size : bytes.size();
}

Result<Datagram> parse(ByteView datagram) {
    if (is_command(datagram)) return read_command(datagram);
    if (is_sound_text(datagram)) return Datagram(SoundText{{datagram.begin(), datagram.end()}});
    if (datagram.size() < header_size + tail_size) return Error{"KMALL", "header", 0, Reason::truncated};
    Steps steps(datagram.first(datagram.size() - tail_size));
    Header header;
    Partition partition;
    steps.take(header);
    const auto tail = wire::load<ByteOrder::little, std::uint32_t>(datagram.data() + datagram.size() - 4);
    if (header.size != datagram.size() || tail != header.size)
        return Error{"KMALL", "size", 0, Reason::wrong_size};
    const auto type = header.type.view();
    if (type == "#IIP" || type == "#IOP") return read_as<Parameters>(steps, header);
    if (type == "#SVP") return read_as<SoundProfile>(steps, header);
    if (type == "#SHA") return read_as<Headings>(steps, header);
    if (type == "#SVT") return read_as<SoundSpeeds>(steps, header);
    if (type == "#SKM") return read_as<Motion>(steps, header);
    if (type == "#CHE") return read_as<PingHeave>(steps, header);
    if (is_sensor(type)) return read_as<Sensor>(steps, header);
    if (type != "#MRZ" && type != "#MWC" && type != "#FCF")
        return Error{"KMALL", "type", 4, Reason::unknown_message};
    if (!steps.take(partition)) return steps.error;
    if (type == "#FCF") return read_as<CalibrationFile>(steps, header, partition);
    if (partition.parts > 1) return read_as<Part>(steps, header, partition);
    return type == "#MRZ" ? read_as<Mrz>(steps, header, partition) : read_as<Mwc>(steps, header, partition);
}

std::string_view name_of(const Datagram& datagram) {
    if (std::holds_alternative<Command>(datagram)) return "KSSIS";
    if (const auto* sound = std::get_if<SoundText>(&datagram))
        return std::string_view(sound->text).substr(3, 3);
    if (const auto* part = std::get_if<Part>(&datagram))
        return part->header.type == wire::Text<4>("#MRZ") ? "MRZ part" : "MWC part";
    return std::visit(
        [](const auto& one) -> std::string_view {
            if constexpr (requires { one.header; }) {
                const std::string_view type = one.header.type.view();
                return type.substr(std::min<std::size_t>(1, type.size()));
            }
            return {};
        },
        datagram);
}

}  // namespace echoloop::kmall
