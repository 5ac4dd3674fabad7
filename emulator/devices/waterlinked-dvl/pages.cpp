#include "emulator/devices/waterlinked-dvl/pages.h"

#include <nlohmann/json.hpp>

namespace echoloop::waterlinked_dvl {
namespace {

using Page = nlohmann::ordered_json;

std::string status_page(double temperature) {
    return Page{{"temperature", temperature}, {"cpu_load", 0.25}, {"disk_free", Page::object()}}.dump();
}

std::string outputs_page(const std::vector<OutputRow>& outputs) {
    Page list = Page::array();
    for (const OutputRow& row : outputs)
        list.push_back({{"id", row.id},
                        {"port", row.port},
                        {"format", row.format},
                        {"clients", row.clients},
                        {"error", ""}});
    return list.dump();
}

}  // namespace

Bytes page(const http::Request& request, const State& state, const std::vector<OutputRow>& outputs,
           const Settings& settings, double temperature) {
    std::string path = request.target.substr(0, request.target.find('?'));
    if (path.ends_with('/')) path.pop_back();
    std::string body;
    if (path == "/api/v1/about")
        body = about_text(settings);
    else if (path == "/api/v1/about/status")
        body = status_page(temperature);
    else if (path == "/api/v1/config")
        body = configuration_text(state.configuration);
    else if (path == "/api/v1/outputs")
        body = outputs_page(outputs);
    else
        return http::response(404);
    return request.method == "GET" ? http::response(200, body) : http::response(405);
}

}  // namespace echoloop::waterlinked_dvl
