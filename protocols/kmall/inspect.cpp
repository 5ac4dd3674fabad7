#include "protocols/kmall/inspect.h"

#include "protocols/kmall/info_layouts.h"
#include "protocols/kmall/sensor_layouts.h"
#include "protocols/kmall/water_layouts.h"
#include "protocols/wire/visit.h"

namespace echoloop::kmall {
namespace {

/// Adds structs one after the other, each as long as its own size says.
class Walk {
  public:
    explicit Walk(inspect::Message& out) : out_(out), at_(out.offset) {}

    template <class T>
    void add(const char* name, const T& one, std::size_t size = *wire::fixed_size<T>()) {
        wire::visit_fields(one, [&](wire::FieldView view) {
            if (view.offset + view.size > size) return;  // of a later version
            view.name = std::string(name) + '.' + view.name;
            out_.fields.push_back(inspect::to_field(view, at_));
        });
        at_ += size;
    }

    /// Structs of `size` bytes: each field as an array, at the place of the first of them.
    template <class T>
    void add_all(const char* name, const std::vector<T>& all, std::size_t size) {
        std::vector<wire::FieldView> columns;
        for (const T& one : all) {
            std::size_t column = 0;
            wire::visit_fields(one, [&](const wire::FieldView& view) {
                if (view.offset + view.size > size) return;
                if (column == columns.size()) {
                    columns.push_back(view);
                    columns.back().name = std::string(name) + '.' + view.name;
                    columns.back().value = std::vector<double>();
                }
                append(columns[column++].value, view.value);
            });
        }
        for (const wire::FieldView& view : columns) out_.fields.push_back(inspect::to_field(view, at_));
        at_ += all.size() * size;
    }

    template <class T>
    void add_numbers(const std::string& name, const std::vector<T>& all, std::size_t size, const char* unit) {
        wire::FieldView view{.name = name, .unit = unit, .offset = 0, .size = all.size() * size};
        view.value = std::vector<double>(all.begin(), all.end());
        out_.fields.push_back(inspect::to_field(view, at_));
        at_ += view.size;
    }

    void add_text(const std::string& name, const std::string& text) {
        wire::FieldView view{.name = name, .offset = 0, .size = text.size(), .value = text};
        out_.fields.push_back(inspect::to_field(view, at_));
        at_ += text.size();
    }

  private:
    static void append(wire::Value& column, const wire::Value& value) {
        auto& numbers = *std::get_if<std::vector<double>>(&column);
        std::visit(
            [&](const auto& v) {
                if constexpr (std::is_arithmetic_v<std::decay_t<decltype(v)>>)
                    numbers.push_back(static_cast<double>(v));
                if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::vector<double>>)
                    numbers.insert(numbers.end(), v.begin(), v.end());
            },
            value);
    }

    inspect::Message& out_;
    std::size_t at_;
};

void add(Walk& walk, const Mrz& m) {
    walk.add("body", m.body, m.body.size);
    walk.add("ping", m.ping, m.ping.size);
    walk.add_all("sectors", m.sectors, m.ping.bytes_per_sector);
    walk.add("rx", m.rx, m.rx.size);
    walk.add_all("classes", m.classes, m.rx.bytes_per_class);
    walk.add_all("soundings", m.soundings, m.rx.bytes_per_sounding);
    if (!m.image.empty()) walk.add_numbers("image", m.image, 2, "0.1 dB");
}

void add(Walk& walk, const Mwc& m) {
    walk.add("body", m.body, m.body.size);
    walk.add("tx", m.tx, m.tx.size);
    walk.add_all("sectors", m.sectors, m.tx.bytes_per_sector);
    walk.add("rx", m.rx, m.rx.size);
    std::size_t number = 0;
    for (const WaterBeam& beam : m.beams) {
        const std::string name = "beams[" + std::to_string(number++) + ']';
        walk.add(name.c_str(), beam.info, m.rx.bytes_per_beam);
        walk.add_numbers(name + ".amplitude", beam.amplitude, 1, "0.5 dB");
        if (!beam.phase.empty()) walk.add_numbers(name + ".phase", beam.phase, m.rx.phase, "");
    }
}

void add(Walk& walk, const Parameters& p) {
    walk.add("info", p.info);
    walk.add_text("text", p.text);
    if (!p.surplus.empty()) walk.add_numbers("surplus", p.surplus, 1, "");
}

void add(Walk& walk, const SoundProfile& p) {
    walk.add("info", p.info, p.info.size);
    walk.add_all("points", p.points, *wire::fixed_size<SoundProfilePoint>());
    if (!p.surplus.empty()) walk.add_numbers("surplus", p.surplus, 1, "");
}

void add(Walk& walk, const Sensor& sensor) {
    walk.add("info", sensor.info, sensor.info.size);
    std::visit([&walk](const auto& values) { walk.add("values", values); }, sensor.values);
    walk.add_text("text", sensor.text);
}

void add(Walk& walk, const Headings& h) {
    walk.add("info", h.info, h.info.size);
    walk.add("about", h.about, h.about.size);
    walk.add_all("samples", h.samples, h.about.bytes_per_sample);
}

void add(Walk& walk, const SoundSpeeds& m) {
    walk.add("info", m.info, m.info.size);
    walk.add_all("samples", m.samples, m.info.bytes_per_sample);
}

void add(Walk& walk, const Motion& m) {
    walk.add("info", m.info, m.info.size);
    walk.add_all("samples", m.samples, m.info.bytes_per_sample);
}

void add(Walk& walk, const PingHeave& m) {
    walk.add("body", m.body, m.body.size);
    walk.add("heave", m.heave);
}

void add(Walk& walk, const CalibrationFile& m) {
    walk.add("info", m.info, m.info.size);
    walk.add_numbers("bytes", m.bytes, 1, "");
}

void add(Walk& walk, const Part& part) { walk.add_numbers("bytes", part.bytes, 1, ""); }

template <class M>
void add_fields(inspect::Message& out, const M& message) {
    Walk walk(out);
    walk.add("header", message.header);
    if constexpr (requires { message.partition; }) walk.add("partition", message.partition);
    add(walk, message);
}

void add_fields(inspect::Message& out, const Command& command) {
    const auto add_field = [&](const char* name, wire::Value value) {
        wire::FieldView view{.name = name, .offset = 0, .size = out.size, .value = std::move(value)};
        out.fields.push_back(inspect::to_field(view, out.offset));
    };
    add_field("number", std::uint64_t{command.number});
    add_field("sounder", command.sounder);
    add_field("arguments", command.arguments);
}

void add_fields(inspect::Message& out, const SoundText& sound) {
    Walk walk(out);
    walk.add_text("text", sound.text);
}

inspect::Message decode_one(wire::ByteView bytes, std::size_t offset) {
    inspect::Message out{.offset = offset, .size = bytes.size()};
    const auto datagram = parse(bytes);
    if (datagram) {
        out.name = name_of(*datagram);
        std::visit([&](const auto& d) { add_fields(out, d); }, *datagram);
    } else {
        out.reason = datagram.error().what();
    }
    return out;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    std::vector<inspect::Message> messages;
    wire::Bytes held;
    std::size_t at = 0;
    do {
        const wire::ByteView rest = bytes.subspan(at);
        const std::size_t size = datagram_size(rest);
        const bool joined = join(held, rest.first(size));
        messages.push_back(decode_one(joined ? held : rest.first(size), at));
        messages.back().size = size;  // of the last part
        at += size;
    } while (at < bytes.size());
    return messages;
}

std::vector<wire::Table> tables() {
    using wire::table_of;
    return {table_of<Header>(),
            table_of<Partition>(),
            table_of<Body>(),
            table_of<PingInfo>(),
            table_of<TxSector>(),
            table_of<RxInfo>(),
            table_of<DetectionClass>(),
            table_of<Sounding>(),
            table_of<WaterTx>(),
            table_of<WaterSector>(),
            table_of<WaterRx>(),
            table_of<WaterBeamInfo>(),
            table_of<ParametersInfo>(),
            table_of<SoundProfileInfo>(),
            table_of<SoundProfilePoint>(),
            table_of<SensorInfo>(),
            table_of<Position>(),
            table_of<PositionError>(),
            table_of<Datum>(),
            table_of<Clock>(),
            table_of<DepthSensor0>(),
            table_of<DepthSensor>(),
            table_of<Height>(),
            table_of<SoundSpeedManager>(),
            table_of<HeadingsInfo>(),
            table_of<HeadingSample>(),
            table_of<SoundSpeedInfo>(),
            table_of<SoundSpeedSample>(),
            table_of<MotionInfo>(),
            table_of<MotionSample>(),
            table_of<Heave>(),
            table_of<FileInfo>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    const auto datagram = parse(bytes);
    return datagram ? serialise(*datagram) : wire::Bytes{};
}

}  // namespace echoloop::kmall
