#include "tools/echoloop/diff/json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace echoloop::diff {
namespace {

using Json = nlohmann::ordered_json;

Json json(const Place& place) {
    Json out{{"message", place.message}};
    if (place.packet != 0) out.update({{"packet", place.packet}, {"time", place.time}});
    return out;
}

Json json(const std::vector<Place>& places) {
    Json out = Json::array();
    for (const Place& place : places) out.push_back(json(place));
    return out;
}

Json json(const Spread& s) {
    if (s.count == 0) return nullptr;
    Json out{{"count", s.count}, {"distinct", s.distinct}};
    if (s.is_text && s.distinct == 1) out["constant"] = s.text;
    if (s.is_text) return out;
    if (s.distinct == 1) out["constant"] = s.least;
    out.update({{"min", s.least},
                {"p05", s.p05},
                {"median", s.median},
                {"p95", s.p95},
                {"max", s.most},
                {"mean", s.mean},
                {"deviation", s.deviation}});
    return out;
}

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::equal:
            return "equal";
        case Verdict::different:
            return "different";
        case Verdict::alike:
            return "alike";
        case Verdict::not_compared:
            return "not compared";
    }
    return "";
}

Json json(const FieldReport& field) {
    Json out{{"name", field.name},
             {"unit", field.unit},
             {"verdict", name_of(field.verdict)},
             {"compared", field.compared},
             {"different", field.different}};
    if (field.different > 0 && field.largest > 0) out["largest"] = field.largest;
    if (field.samples) out.update({{"rms_a", field.rms_a}, {"rms_b", field.rms_b}});
    out.update({{"a", json(field.spreads.a)}, {"b", json(field.spreads.b)}});
    if (field.spreads.distance >= 0) out["distance"] = field.spreads.distance;
    if (field.first) {
        Json a = json(field.first->a), b = json(field.first->b);
        a["value"] = field.first->value_a;
        b["value"] = field.first->value_b;
        out["first"] = {{"a", a}, {"b", b}};
    }
    return out;
}

Json json(const TypeReport& type) {
    Json fields = Json::array();
    for (const FieldReport& field : type.fields) fields.push_back(json(field));
    return {{"name", type.name},
            {"a", type.a},
            {"b", type.b},
            {"pairs", type.pairs},
            {"only_a", json(type.only_a)},
            {"only_b", json(type.only_b)},
            {"fields", fields},
            {"gap", {{"a", json(type.gap_a)}, {"b", json(type.gap_b)}}},
            {"own_gap", {{"a", json(type.own_gap_a)}, {"b", json(type.own_gap_b)}}},
            {"answer", {{"a", json(type.answer_a)}, {"b", json(type.answer_b)}}}};
}

Json json(const DirectionReport& direction) {
    Json types = Json::array();
    for (const TypeReport& type : direction.types) types.push_back(json(type));
    return {{"family", direction.family},
            {"a", direction.a},
            {"b", direction.b},
            {"undecoded_a", direction.undecoded_a},
            {"undecoded_b", direction.undecoded_b},
            {"types", types}};
}

}  // namespace

std::string report_json(const Report& report) {
    Json directions = Json::array();
    for (const DirectionReport& direction : report.directions) directions.push_back(json(direction));
    const Json all{{"equal", !report.differs()},
                   {"a", {{"file", report.file_a}, {"messages", report.messages_a}}},
                   {"b", {{"file", report.file_b}, {"messages", report.messages_b}}},
                   {"directions", directions},
                   {"warnings", report.warnings}};
    return all.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace echoloop::diff
