#include "protocols/cerulean/omniscan_codec.h"

#include "protocols/cerulean/codec_rows.h"
#include "protocols/cerulean/omniscan_layouts.h"

namespace echoloop::cerulean::omniscan {

constexpr Id id_of(Tag<OsPingParams>) { return Id::os_ping_params; }
constexpr Id id_of(Tag<OsMonoProfile>) { return Id::os_mono_profile; }

std::vector<wire::Table> tables() { return {table_of<OsPingParams>(), table_of<OsMonoProfile>()}; }

}  // namespace echoloop::cerulean::omniscan

template struct echoloop::cerulean::Codec<echoloop::cerulean::omniscan::Message>;
