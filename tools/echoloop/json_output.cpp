#include "tools/echoloop/json_output.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "emulator/scenario/profile_section.h"
#include "tools/echoloop/common.h"
#include "tools/echoloop/conditions.h"
#include "tools/echoloop/declared_materials.h"
#include "tools/echoloop/json_line.h"
#include "tools/echoloop/time_budget.h"

namespace echoloop::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Text from files may hold bytes that are no UTF-8; they are replaced, never an error.
std::string document(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace); }
Json triple(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

Json pose(const Pose& p) {
    return {{"position", triple(p.position)},
            {"orientation_wxyz",
             Json::array({p.orientation.w, p.orientation.x, p.orientation.y, p.orientation.z})}};
}

Json option_value(const OptionValue& value) {
    return std::visit([](const auto& v) { return Json(v); }, value);
}

Json option(const Option& o) {
    static constexpr const char* types[] = {"boolean", "integer", "number", "text"};
    Json json{{"name", o.name}, {"type", types[o.default_value.index()]},
              {"unit", o.unit}, {"default", option_value(o.default_value)},
              {"help", o.help}, {"source", o.source}};
    if (!o.choices.empty()) json["choices"] = o.choices;
    if (o.minimum > -1e300) json["minimum"] = o.minimum;
    if (o.maximum < 1e300) json["maximum"] = o.maximum;
    return json;
}

Json figure_value(const Figure& figure) {
    return std::visit([](const auto& v) { return Json(v); }, figure.value);
}

Json figures(const Model& m) {
    Json list = Json::array();
    const Profile profile = own_profile(m);
    for (const auto& row : m.figures) {
        const Figure& f = profile.at(row.name);
        Json json{{"name", row.name},
                  {"value", figure_value(f)},
                  {"unit", row.unit},
                  {"help", row.help},
                  {"source", f.source}};
        if (row.check != nullptr) {
            json["notation"] = true;
        } else if (row.choices.empty()) {
            json.update({{"minimum", row.minimum}, {"maximum", row.maximum}});
        } else {
            json["choices"] = row.choices;
        }
        list.push_back(json);
    }
    return list;
}

Json model(const Model& m) {
    Json options = Json::array();
    for (const auto& o : m.options) options.push_back(option(o));
    return {{"name", m.name},
            {"title", m.title},
            {"protocol", m.protocol},
            {"default_endpoints", m.default_endpoints},
            {"endpoint_schemes", m.endpoint_schemes},
            {"turn_steps", m.turn_steps},
            {"options", options},
            {"profile", figures(m)}};
}

std::vector<std::string> uris(const std::vector<Endpoint>& endpoints) {
    std::vector<std::string> all;
    for (const Endpoint& endpoint : endpoints) all.push_back(to_string(endpoint));
    return all;
}

Json device(const ScenarioDevice& d) {
    Json options = Json::object(), profile = Json::object();
    for (const auto& [name, figure] : d.config.profile) profile[name] = figure_value(figure);
    for (const auto& [name, value] : d.config.options) options[name] = option_value(value);
    return {{"name", d.name},
            {"model", d.model->name},
            {"mount", pose(d.body_from_sonar)},
            {"endpoints", uris(d.config.endpoints)},
            {"options", options},
            {"profile", profile}};
}

Json effects(const Scenario& s) {
    Json json = Json::object();
    const auto off = effects_off(s);
    for (const auto& row : effect_rows)
        json[std::string(row.name)] = std::ranges::find(off, row.name) == off.end();
    return json;
}

Json straight_rays(const Scenario& s) {
    Json list = Json::array();
    for (const auto& b : ray_bounds(s))
        list.push_back({{"device", b.device}, {"range_m", b.range}, {"error_m", b.error.displacement}});
    return list;
}

Json scene_json(const std::string& file, const Scene& scene) {
    Json materials = Json::array();
    for (const auto& m : declared_materials(scene))
        materials.push_back({{"name", m.name}, {"mu_db", m.mu_db}, {"double_sided", m.double_sided}});
    return {{"file", file},
            {"triangles", scene.triangles()},
            {"objects", std::vector<std::string>(scene.objects().begin(), scene.objects().end())},
            {"materials", materials},
            {"bounds", {{"min", scene.bounds().min}, {"max", scene.bounds().max}}}};
}

Json spread(const bench::Spread& s) { return {{"minimum", s.minimum}, {"median", s.median}, {"p99", s.p99}}; }

Json bench_row(const bench::Row& row) {
    const bench::Figures& f = row.figures;
    Json json{{"case", row.the_case.name()},
              {"sonar", row.the_case.sonar},
              {"scene", row.the_case.scene},
              {"rule", row.rule == EchoRule::radiometric ? "radiometric" : "cerqueira2016"},
              {"beams", row.the_case.shot.bearings.size()},
              {"bins", row.the_case.shot.bins}};
    if (f.failure[0] != '\0') {
        json["failure"] = f.failure;
        return json;
    }
    json.update({{"wall_ms", spread(f.wall)},
                 {"cpu_ms", spread(f.cpu)},
                 {"split_ms",
                  {{"cull", f.cull},
                   {"draw", f.draw},
                   {"read_back", f.read_back},
                   {"bins", f.bins},
                   {"paths", f.paths},
                   {"acoustics", f.acoustics}}},
                 {"scene_triangles", f.scene_triangles},
                 {"triangles", f.triangles},
                 {"pixels", f.pixels},
                 {"start_up_s", f.start_up},
                 {"start_up_cpu_s", f.start_up_cpu},
                 {"resident_mb", f.resident},
                 {"peak_mb", f.peak},
                 {"context", f.context}});
    if (f.straight_cpu > 0) json["straight_cpu_ms"] = f.straight_cpu;
    if (const auto& target = row.the_case.target)
        json["target"] = {{"aim_ms", target->aim},
                          {"least_ms", target->least},
                          {"reference", target->reference},
                          {"reached", bench::reached(row)}};
    return json;
}

/// s each; null: not known without a driver.
Json ping_time(const TimeBudget& b) {
    const auto known = [](const auto& value) { return value ? Json(*value) : Json(); };
    return {{"transmit", b.transmit},  {"listen", b.listen},      {"motor", known(b.motor)},
            {"work", known(b.work)},   {"bytes", known(b.bytes)}, {"wire", known(b.wire)},
            {"line_rate", b.line_rate}};
}

}  // namespace

std::string problems_json(const std::vector<Problem>& problems) {
    Json list = Json::array();
    for (const auto& p : problems)
        list.push_back({{"where", p.where}, {"line", p.line}, {"column", p.column}, {"message", p.message}});
    return document({{"ok", false}, {"problems", list}});
}

std::string check_json(const Scenario& s, const Scene& scene) {
    Json devices = Json::array();
    for (const auto& d : s.devices) {
        devices.push_back(device(d));
        if (d.model->default_shot != nullptr) devices.back()["ping_time"] = ping_time(time_budget(d));
    }
    const Json water{{"temperature", s.water.temperature},
                     {"salinity", s.water.salinity},
                     {"ph", s.water.ph},
                     {"depth", s.water.depth},
                     {"sound_speed", sound_speed(s.water)}};
    return document({{"ok", true},
                     {"file", s.file.string()},
                     {"scene", scene_json(s.scene.string(), scene)},
                     {"seed", s.seed},
                     {"water", water},
                     {"vehicle", pose(s.world_from_body)},
                     {"clock_rate", s.clock_rate},
                     {"clock", clock_text(s)},
                     {"effects", effects(s)},
                     {"straight_rays", straight_rays(s)},
                     {"warnings", warnings(s)},
                     {"devices", devices}});
}

std::string list_json(std::span<const Model> models) {
    Json list = Json::array();
    for (const auto& m : models) list.push_back(model(m));
    return document({{"models", list}});
}

std::string endpoints_json(const std::string& format, const std::vector<DeviceEndpoints>& devices) {
    Json list = Json::array();
    for (const auto& [device, places, hint] : devices) {
        Json entry{{"name", device->name},
                   {"model", device->model->name},
                   {"endpoints", uris(device->config.endpoints)},
                   {"places", Json::array()}};
        for (const auto& place : places)
            entry["places"].push_back({{"what", place.what}, {"address", place.address}});
        if (!format.empty())
            entry.update({{"driver", hint.driver}, {"paste", hint.paste}, {"note", hint.note}});
        list.push_back(entry);
    }
    Json json{{"devices", list}};
    if (!format.empty()) json["format"] = format;
    return document(json);
}

std::string render_json(const RenderReport& report) {
    Json json{{"out", report.out},
              {"device", report.device},
              {"model", report.model},
              {"renderer", report.renderer},
              {"pings", report.pings.size()}};
    if (report.pings.empty()) return document(json);
    const auto& first = report.pings.front();
    float strongest = 0;
    for (const auto& ping : report.pings)
        for (const float value : ping.values) strongest = std::max(strongest, value);
    const bool radiometric = first.rule == EchoRule::radiometric;
    json.update(
        {{"beams", first.beams()},
         {"bins", first.shot.bins},
         {"first_bin_m", first.bin_range(0)},
         {"last_bin_m", first.bin_range(first.shot.bins - 1)},
         {"frequency_hz", first.shot.frequency},
         {"sound_speed", first.sound_speed},
         {"rule", radiometric ? "radiometric" : "cerqueira2016"},
         {radiometric ? "strongest_db" : "strongest", radiometric ? level_db(strongest) : strongest}});
    return document(json);
}

std::string doctor_json(const Findings& findings) {
    static constexpr const char* words[] = {"good", "weak", "bad"};
    Json list = Json::array();
    bool ok = true;
    for (const Finding& f : findings) {
        ok = ok && f.state != Finding::State::bad;
        list.push_back({{"state", words[static_cast<int>(f.state)]},
                        {"name", f.name},
                        {"text", f.text},
                        {"remedy", f.remedy}});
    }
    return line_of({{"ok", ok}, {"findings", list}});
}

std::string bench_json(const bench::Report& report) {
    Json cases = Json::array(), limits = Json::array();
    for (const auto& row : report.rows) cases.push_back(bench_row(row));
    for (const auto& limit : bench::limits_of(report))
        limits.push_back({{"what", limit.what},
                          {"ours", limit.ours},
                          {"most", limit.most},
                          {"unit", limit.unit},
                          {"met", limit.met()}});
    return document({{"pings", report.settings.pings},
                     {"pixel_density", report.settings.pixel_density},
                     {"cases", cases},
                     {"limits", limits}});
}

std::string validate_json(const validation::Findings& findings) {
    static constexpr const char* bounds[] = {"within", "at_most", "at_least"};
    Json list = Json::array();
    for (const auto& q : findings.quantities())
        list.push_back({{"id", q.id},
                        {"quantity", q.name},
                        {"unit", q.unit},
                        {"bound", bounds[static_cast<int>(q.bound)]},
                        {"published", q.published},
                        {"tolerance", q.tolerance},
                        {"ours", q.ours},
                        {"pass", q.passed()},
                        {"required", q.required},
                        {"kind", std::string(validation::name_of(q.kind))},
                        {"source", q.source}});
    return document({{"ok", findings.failed() == 0}, {"failed", findings.failed()}, {"quantities", list}});
}

}  // namespace echoloop::cli
