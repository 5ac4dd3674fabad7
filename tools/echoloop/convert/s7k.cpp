// .s7k: records without network frames between a file header and a catalogue.
#include <set>

#include "protocols/reson7k/codec.h"
#include "protocols/reson7k/framer.h"
#include "protocols/reson7k/layouts.h"
#include "protocols/wire/read.h"
#include "protocols/wire/write.h"
#include "tools/echoloop/convert/recording.h"

namespace echoloop::convert {
namespace {

constexpr std::uint32_t centre = 7000;

/// What only a host and a sonar say to each other.
bool is_talk(std::uint32_t type) { return type == 7500 || type == 7501 || type == 7502; }

class S7k final : public Recording {
  public:
    void look(const Heard& heard) override {
        for_records(heard.bytes, [this](const reson7k::Record& record) {
            devices_.insert({record.frame.device, record.frame.enumerator});
            ++records_;
            bytes_ += reson7k::encode(record).size();
            if (!begun_) time_ = record.frame.time;
            begun_ = true;
        });
    }

    void begin(std::ostream& out) override {
        const Bytes header = file_header(0);
        const Bytes whole = file_header(header.size() + bytes_);
        put(out, whole);
        note(whole);
    }

    void add(const Heard& heard, std::ostream& out) override {
        for_records(heard.bytes, [&](const reson7k::Record& record) {
            const Bytes bytes = reson7k::encode(record);
            put(out, bytes);
            note(bytes);
            ++count_;
        });
    }

    void end(std::ostream& out) override { put(out, reson7k::encode(catalogue_, frame_of_file())); }

  private:
    template <class Each>
    static void for_records(ByteView bytes, Each each) {
        reson7k::Framer framer;
        framer.feed(bytes);
        framer.finish();
        while (const auto record = framer.next())
            if (!is_talk(record->frame.type)) each(*record);
    }

    reson7k::RecordFrame frame_of_file() const {
        reson7k::RecordFrame frame;
        frame.device = centre;
        frame.time = time_;
        return frame;
    }

    /// At its end, as optional data, where the catalogue is.
    Bytes file_header(std::uint64_t catalogue_at) const {
        constexpr std::size_t optional = 12;
        reson7k::FileHeader header;
        header.name = "echoloop";
        for (const auto& [device, enumerator] : devices_) header.devices.push_back({device, enumerator});
        header.optional.resize(optional);
        constexpr std::size_t entry = *wire::fixed_size<reson7k::CatalogueEntry>();
        wire::store<wire::ByteOrder::little>(static_cast<std::uint32_t>(entry * (records_ + 1)),
                                             header.optional.data());
        wire::store<wire::ByteOrder::little>(catalogue_at, header.optional.data() + 4);
        reson7k::RecordFrame frame = frame_of_file();
        const std::size_t size = reson7k::encode(header, frame).size();
        frame.optional_offset = static_cast<std::uint32_t>(size - reson7k::checksum_size - optional);
        return reson7k::encode(header, frame);
    }

    void note(ByteView record) {
        const auto frame = reson7k::plausible_record_frame(record);
        if (!frame) return;
        reson7k::CatalogueEntry entry;
        entry.size = frame->size;
        entry.offset = at_;
        entry.record_type = static_cast<std::uint16_t>(frame->type);
        entry.device = static_cast<std::uint16_t>(frame->device);
        entry.enumerator = frame->enumerator;
        entry.time = frame->time;
        entry.records = 1;
        catalogue_.entries.push_back(entry);
        at_ += record.size();
    }

    std::set<std::pair<std::uint32_t, std::uint16_t>> devices_;
    std::uint64_t bytes_ = 0, records_ = 0, at_ = 0;
    reson7k::Time7k time_;
    bool begun_ = false;
    reson7k::FileCatalogue catalogue_;
};

}  // namespace

std::unique_ptr<Recording> make_s7k() { return std::make_unique<S7k>(); }

}  // namespace echoloop::convert
