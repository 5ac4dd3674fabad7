#include "protocols/cerulean/s500_codec.h"

#include "protocols/cerulean/codec_rows.h"
#include "protocols/cerulean/s500_layouts.h"

namespace echoloop::cerulean::s500 {

constexpr Id id_of(Tag<SetPingParams>) { return Id::s500_ping_params; }
constexpr Id id_of(Tag<FwVersion>) { return Id::fw_version; }
constexpr Id id_of(Tag<SpeedOfSound>) { return Id::speed_of_sound; }
constexpr Id id_of(Tag<Range>) { return Id::range; }
constexpr Id id_of(Tag<PingRate>) { return Id::ping_rate; }
constexpr Id id_of(Tag<GainIndex>) { return Id::gain_index; }
constexpr Id id_of(Tag<Altitude>) { return Id::altitude; }
constexpr Id id_of(Tag<ProcessorTemperature>) { return Id::processor_temperature; }
constexpr Id id_of(Tag<Distance2>) { return Id::distance2; }
constexpr Id id_of(Tag<Profile6>) { return Id::profile6; }

std::vector<wire::Table> tables() {
    return {table_of<SetPingParams>(), table_of<FwVersion>(), table_of<SpeedOfSound>(),
            table_of<Range>(),         table_of<PingRate>(),  table_of<GainIndex>(),
            table_of<Altitude>(),      table_of<Distance2>(), table_of<ProcessorTemperature>(),
            table_of<Profile6>()};
}

}  // namespace echoloop::cerulean::s500

template struct echoloop::cerulean::Codec<echoloop::cerulean::s500::Message>;
