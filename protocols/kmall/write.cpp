#include "protocols/wire/write.h"
#include "protocols/kmall/codec.h"
#include "protocols/kmall/sizes.h"
#include "protocols/wire/read.h"

namespace echoloop::kmall {
namespace {

using wire::ByteOrder;
using wire::Bytes;
using wire::ByteView;

/// Grows by structs, each as long as its size says.
class Pieces {
  public:
    template <class T>
    void add(const T& one, std::size_t size) {
        Bytes bytes = wire::serialise(one);
        bytes.resize(size);
        out.insert(out.end(), bytes.begin(), bytes.end());
    }
    template <class Wire>
    void add_number(Wire value) {
        out.resize(out.size() + sizeof value);
        wire::store<ByteOrder::little>(value, out.data() + out.size() - sizeof value);
    }

    template <class Range>
    void add_bytes(const Range& bytes) {
        out.insert(out.end(), bytes.begin(), bytes.end());
    }

    Bytes out;
};

template <class Size>
Size or_known(Size size, std::size_t known) {
    return size == 0 ? static_cast<Size>(known) : size;
}

template <class T>
void add_sized(Pieces& pieces, T one) {
    one.size = or_known(one.size, known_size<T>);
    pieces.add(one, one.size);
}

void write(Pieces& pieces, Mrz m) {
    m.ping.tx_sectors = static_cast<std::uint16_t>(m.sectors.size());
    m.ping.bytes_per_sector = or_known(m.ping.bytes_per_sector, known_size<TxSector>);
    m.rx.soundings = static_cast<std::uint16_t>(m.soundings.size() - m.rx.extra_detections);
    m.rx.bytes_per_sounding = or_known(m.rx.bytes_per_sounding, known_size<Sounding>);
    m.rx.classes = static_cast<std::uint16_t>(m.classes.size());
    m.rx.bytes_per_class = or_known(m.rx.bytes_per_class, known_size<DetectionClass>);
    add_sized(pieces, m.body);
    add_sized(pieces, m.ping);
    for (const TxSector& sector : m.sectors) pieces.add(sector, m.ping.bytes_per_sector);
    add_sized(pieces, m.rx);
    for (const DetectionClass& one : m.classes) pieces.add(one, m.rx.bytes_per_class);
    for (const Sounding& sounding : m.soundings) pieces.add(sounding, m.rx.bytes_per_sounding);
    for (const std::int16_t sample : m.image) pieces.add_number(sample);
}

void write(Pieces& pieces, Mwc m) {
    m.tx.sectors = static_cast<std::uint16_t>(m.sectors.size());
    m.tx.bytes_per_sector = or_known(m.tx.bytes_per_sector, known_size<WaterSector>);
    m.rx.beams = static_cast<std::uint16_t>(m.beams.size());
    m.rx.bytes_per_beam = or_known(m.rx.bytes_per_beam, known_size<WaterBeamInfo>);
    add_sized(pieces, m.body);
    add_sized(pieces, m.tx);
    for (const WaterSector& sector : m.sectors) pieces.add(sector, m.tx.bytes_per_sector);
    add_sized(pieces, m.rx);
    for (WaterBeam& beam : m.beams) {
        beam.info.samples = static_cast<std::uint16_t>(beam.amplitude.size());
        pieces.add(beam.info, m.rx.bytes_per_beam);
        const auto* samples = reinterpret_cast<const std::uint8_t*>(beam.amplitude.data());
        pieces.out.insert(pieces.out.end(), samples, samples + beam.amplitude.size());
        for (const std::int16_t phase : beam.phase) {
            if (m.rx.phase == 1) pieces.add_number(static_cast<std::int8_t>(phase));
            if (m.rx.phase == 2) pieces.add_number(phase);
        }
    }
}

void write(Pieces& pieces, Parameters p) {
    p.info.size = static_cast<std::uint16_t>(known_size<ParametersInfo> + p.text.size());
    pieces.add(p.info, known_size<ParametersInfo>);
    pieces.add_bytes(p.text);
    pieces.add_bytes(p.surplus);
}

void write(Pieces& pieces, SoundProfile p) {
    p.info.points = static_cast<std::uint16_t>(p.points.size());
    add_sized(pieces, p.info);
    for (const SoundProfilePoint& point : p.points) pieces.add(point, known_size<SoundProfilePoint>);
    pieces.add_bytes(p.surplus);
}

void write(Pieces& pieces, const Part& part) { pieces.add_bytes(part.bytes); }

void write(Pieces& pieces, const Sensor& sensor) {
    add_sized(pieces, sensor.info);
    std::visit([&pieces]<class T>(const T& values) { pieces.add(values, known_size<T>); }, sensor.values);
    pieces.add_bytes(sensor.text);
}

void write(Pieces& pieces, Headings h) {
    const std::size_t text = h.texts.empty() ? 0 : h.texts.front().size();
    h.about.samples = static_cast<std::uint16_t>(h.samples.size());
    h.about.bytes_per_sample = static_cast<std::uint16_t>(known_size<HeadingSample> + text);
    add_sized(pieces, h.info);
    add_sized(pieces, h.about);
    for (std::size_t i = 0; i < h.samples.size(); ++i) {
        pieces.add(h.samples[i], known_size<HeadingSample>);
        std::string sentence = i < h.texts.size() ? h.texts[i] : "";
        sentence.resize(text);
        pieces.add_bytes(sentence);
    }
}

template <class M>
void write_samples(Pieces& pieces, M m) {
    m.info.samples = static_cast<std::uint16_t>(m.samples.size());
    const std::size_t known = known_size<typename decltype(m.samples)::value_type>;
    m.info.bytes_per_sample = or_known(m.info.bytes_per_sample, known);
    add_sized(pieces, m.info);
    for (const auto& sample : m.samples) pieces.add(sample, m.info.bytes_per_sample);
}
void write(Pieces& pieces, const SoundSpeeds& m) { write_samples(pieces, m); }
void write(Pieces& pieces, const Motion& m) { write_samples(pieces, m); }

void write(Pieces& pieces, const PingHeave& m) {
    add_sized(pieces, m.body);
    pieces.add(m.heave, known_size<Heave>);
}

void write(Pieces& pieces, const CalibrationFile& m) {
    add_sized(pieces, m.info);
    pieces.add_bytes(m.bytes);
}

template <class M>
Bytes bytes_of(const M& message) {
    Pieces pieces;
    pieces.add(message.header, header_size);
    if constexpr (requires { message.partition; }) pieces.add(message.partition, known_size<Partition>);
    write(pieces, message);
    const auto size = static_cast<std::uint32_t>(pieces.out.size() + tail_size);
    wire::store<ByteOrder::little>(size, pieces.out.data());
    pieces.add_number(size);
    return std::move(pieces.out);
}

Bytes bytes_of(const Command& command) {
    std::string text(command_word);
    text += std::to_string(command.number) + ',' + command.sounder + command.arguments;
    return {text.begin(), text.end()};
}

Bytes bytes_of(const SoundText& sound) { return {sound.text.begin(), sound.text.end()}; }

}  // namespace

Bytes serialise(const Datagram& datagram) {
    return std::visit([](const auto& one) { return bytes_of(one); }, datagram);
}

std::vector<Bytes> divided(Bytes datagram, std::size_t largest) {
    constexpr std::size_t before = header_size + known_size<Partition>, around = before + tail_size;
    const bool divisible = datagram.size() > largest && datagram[5] == 'M';  // #MRZ, #MWC
    if (!divisible) return {std::move(datagram)};
    const std::size_t most = (largest - around) / 2 * 2;
    Part part;
    part.header = *wire::parse<Header>(ByteView(datagram).first(header_size));
    const ByteView all = ByteView(datagram).subspan(before, datagram.size() - around);
    part.partition.parts = static_cast<std::uint16_t>((all.size() + most - 1) / most);
    std::vector<Bytes> parts;
    for (std::size_t at = 0; at < all.size(); at += most) {
        const ByteView piece = all.subspan(at, std::min(most, all.size() - at));
        part.bytes.assign(piece.begin(), piece.end());
        ++part.partition.part;
        parts.push_back(bytes_of(part));
    }
    return parts;
}

bool join(Bytes& held, ByteView bytes) {
    constexpr std::size_t most = std::size_t{8} << 20;  // B; beyond any datagram of 1024 beams that is sent
    constexpr std::size_t before = header_size + known_size<Partition>, part_at = header_size + 2;
    const auto number = [](ByteView of, std::size_t at) {
        return wire::load<ByteOrder::little, std::uint16_t>(of.data() + at);
    };
    if (bytes.size() < before || bytes[4] != '#' || number(bytes, header_size) < 2) return false;
    const auto datagram = parse(bytes);
    const auto* part = datagram ? std::get_if<Part>(&*datagram) : nullptr;
    if (part == nullptr) return false;
    if (part->partition.part == 1) {
        held.assign(bytes.begin(), bytes.end() - tail_size);
    } else {
        // All but the size is the same in all headers; `held` counts its parts in its own partition.
        const bool follows = held.size() >= before && number(held, part_at) + 1 == part->partition.part &&
                             std::equal(held.begin() + 4, held.begin() + part_at, bytes.begin() + 4);
        if (!follows || held.size() + part->bytes.size() > most) held.clear();
        if (held.empty()) return false;
        held.insert(held.end(), part->bytes.begin(), part->bytes.end());
        wire::store<ByteOrder::little>(part->partition.part, held.data() + part_at);
    }
    if (part->partition.part != part->partition.parts) return false;
    for (const std::size_t at : {header_size, part_at})
        wire::store<ByteOrder::little>(std::uint16_t{1}, held.data() + at);
    const auto size = static_cast<std::uint32_t>(held.size() + tail_size);
    wire::store<ByteOrder::little>(size, held.data());
    held.resize(size);
    wire::store<ByteOrder::little>(size, held.data() + size - tail_size);
    return true;
}

}  // namespace echoloop::kmall
