// echoloop dissector: the Lua script by which Wireshark and tshark read every protocol family, made from the
// codecs' own field tables. Reads no capture.
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "protocols/inspect.h"
#include "tools/echoloop/dissector/lua_tables.h"
#include "tools/echoloop/dissector/parts.h"
#include "tools/echoloop/output_file.h"
#include "tools/echoloop/verb.h"

namespace echoloop::cli {
namespace {

/// Each part has a scope of its own: Lua allows 200 local names in one.
std::string scoped(std::string_view text) { return "do\n" + std::string(text) + "end\n\n"; }

std::string script() {
    std::string out =
        "-- Sonar protocols for Wireshark and tshark, made by echoloop " ECHOLOOP_VERSION
        " from the field tables of its\n-- codecs. Put it into the folder of personal Lua plugins (Help > "
        "About Wireshark > Folders), or start\n-- tshark -X lua_script:echoloop.lua\n\n"
        "local sonar = {families = {}, tables = {}}\n\n";
    for (const char* part : {"fields", "walk", "protobuf", "checks", "stream", "places", "ping_frames"})
        out += scoped(lua_part(part));
    for (const inspect::Family& family : inspect::families()) {
        const std::string name(family.name);
        out += "sonar.tables." + name + " = " + lua_tables(family) + "\n\n";
        out += "sonar.add_family(" + lua_text(name) + ", " + lua_text(family.title) + ", " +
               lua_places(family.places) + ")\n\n";
    }
    for (const inspect::Family& family : inspect::families()) out += scoped(lua_part(family.name));
    return out + scoped(lua_part("register"));
}

int run(const Arguments& arguments) {
    const std::string text = script();
    if (!arguments.has("--out")) {
        std::fwrite(text.data(), 1, text.size(), stdout);
        return 0;
    }
    const std::string file = arguments.text("--out");
    require_creatable(file);
    write_whole(file, [&](const std::filesystem::path& path) {
        std::ofstream out(path, std::ios::binary);
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
        out.close();
        if (!out) throw std::runtime_error("writing failed; is the disk full?");
    });
    return 0;
}

}  // namespace

Verb dissector_verb() {
    using Kind = Argument::Kind;
    return {"dissector",
            "print a dissector of all protocols for Wireshark and tshark",
            {{Kind::value, "--out", "FILE", "write it to a file instead of standard output"}},
            "  echoloop dissector > ~/.local/lib/wireshark/plugins/echoloop.lua\n"
            "  tshark -X lua_script:echoloop.lua -r dive.pcapng -T fields -e sonar.seanet.HeadData.bearing",
            run};
}

}  // namespace echoloop::cli
