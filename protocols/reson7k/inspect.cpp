#include "protocols/reson7k/inspect.h"

#include "protocols/inspect_stream.h"
#include "protocols/reson7k/codec.h"
#include "protocols/reson7k/framer.h"
#include "protocols/reson7k/layouts.h"

namespace echoloop::reson7k {
namespace {

inspect::Message inspected(const Record& record, std::size_t offset, std::size_t size) {
    inspect::Message out{.offset = offset, .size = size, .name = name_of(record.frame.type)};
    inspect::add_fields(out, record.frame);
    if (const auto message = parse(record)) {
        std::visit([&](const auto& m) { inspect::add_fields(out, m); }, *message);
    } else {
        out.reason = message.error().what();
    }
    return out;
}

}  // namespace

std::vector<inspect::Message> decode(wire::ByteView bytes) {
    return inspect::decode_stream<Framer>(bytes, inspected);
}

/// A frame is a sure sign; a whole record may be longer than what is looked at.
bool recognise(wire::ByteView bytes) {
    for (; bytes.size() >= record_frame_size; bytes = bytes.subspan(1)) {
        if (bytes[0] != 5) continue;
        if (plausible_record_frame(bytes)) return true;
    }
    return false;
}

std::vector<wire::Table> tables() {
    using wire::table_of;
    return {table_of<NetworkFrame>(),   table_of<RecordFrame>(),    table_of<Time7k>(),
            table_of<SonarSettings>(),  table_of<Settings>(),       table_of<Conditions>(),
            table_of<Configuration>(),  table_of<BeamGeometry>(),   table_of<Image>(),
            table_of<Beamformed>(),     table_of<RawDetections>(),  table_of<Detection>(),
            table_of<WaterColumn>(),    table_of<RemoteControl>(),  table_of<Acknowledge>(),
            table_of<NotAcknowledge>(), table_of<RemoteSettings>(), table_of<RemoteExtras>(),
            table_of<AbsorptionLoss>(), table_of<SpreadingLoss>(),  table_of<FileHeader>(),
            table_of<FileDevice>(),     table_of<FileCatalogue>(),  table_of<CatalogueEntry>()};
}

wire::Bytes rewritten(wire::ByteView bytes) {
    const auto network = plausible_network_frame(bytes);
    Framer framer;
    framer.feed(bytes);
    const auto record = framer.next();
    const auto message = record ? parse(*record) : wire::Result<Message>(wire::Error{});
    if (!network || !message) return {};
    wire::Bytes out;
    for (const auto& packet :
         packets_of(encode(*message, record->frame), network->transmission, network->source_device))
        out.insert(out.end(), packet.begin(), packet.end());
    return out;
}

/// A long record is several packets; the last one holds its sum, which is 0 if there is none.
std::vector<ChecksumPlace> checksums(wire::ByteView bytes) {
    std::vector<ChecksumPlace> places;
    std::size_t at = 0;
    while (const auto frame = plausible_network_frame(bytes.subspan(at))) {
        if (frame->packet_size > bytes.size() - at) break;
        at += frame->packet_size;
        if (frame->sequence + 1 != frame->packets) continue;
        const std::size_t sum = at - checksum_size;
        if (wire::load<wire::ByteOrder::little, std::uint32_t>(bytes.data() + sum) != 0)
            places.push_back({sum, checksum_size});
    }
    return places;
}

}  // namespace echoloop::reson7k
