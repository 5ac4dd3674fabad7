// All field tables of SeaNet. Includes only.
#pragma once

#include "protocols/seanet/command_layouts.h"   // IWYU pragma: export
#include "protocols/seanet/profiler_layouts.h"  // IWYU pragma: export
#include "protocols/seanet/reply_layouts.h"     // IWYU pragma: export
