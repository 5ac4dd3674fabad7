#include "protocols/cerulean/surveyor_codec.h"

#include "protocols/cerulean/codec_rows.h"
#include "protocols/cerulean/surveyor_layouts.h"

namespace echoloop::cerulean::surveyor {

constexpr Id id_of(Tag<UtcRequest>) { return Id::utc_request; }
constexpr Id id_of(Tag<UtcResponse>) { return Id::utc_response; }
constexpr Id id_of(Tag<SetNetInfo>) { return Id::set_net_info; }
constexpr Id id_of(Tag<WaterStats>) { return Id::water_stats; }
constexpr Id id_of(Tag<AttitudeReport>) { return Id::attitude_report; }
constexpr Id id_of(Tag<YzPointData>) { return Id::yz_point_data; }
constexpr Id id_of(Tag<AtofPointData>) { return Id::atof_point_data; }
constexpr Id id_of(Tag<PingParameters>) { return Id::surveyor_ping_parameters; }

std::vector<wire::Table> tables() {
    using wire::table_of;
    return {table_of<UtcRequest>(),     table_of<UtcResponse>(), table_of<SetNetInfo>(),
            table_of<WaterStats>(),     table_of<YzPoint>(),     table_of<AtofPoint>(),
            table_of<AttitudeReport>(), table_of<YzPointData>(), table_of<AtofPointData>(),
            table_of<PingParameters>()};
}

}  // namespace echoloop::cerulean::surveyor

template struct echoloop::cerulean::Codec<echoloop::cerulean::surveyor::Message>;
