#include "tools/echoloop/diff/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "emulator/scenario/problems.h"
#include "tools/echoloop/common.h"

namespace echoloop::diff {
namespace {

using cli::counted;
using cli::padded;
using cli::plain;
using scenario::printable;

std::string place(const Place& p) {
    std::string text = "message " + std::to_string(p.message);
    if (p.packet == 0) return text;
    return text + ", packet " + std::to_string(p.packet) +
           ", t=" + (std::abs(p.time) < 1e9 ? plain(p.time, 6) : number_text(p.time)) + " s";
}

/// For differences, whose last digits say nothing.
std::string rounded(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string samples_text(const FieldReport& field) {
    char text[120];
    const double decibels =
        field.rms_a > 0 && field.rms_b > 0 ? 20 * std::log10(field.rms_b / field.rms_a) : 0;
    std::snprintf(text, sizeof text, "rms %.6g in A, %.6g in B (%+.2f dB)", field.rms_a, field.rms_b,
                  decibels);
    return text;
}

void print_first(const FieldReport& field) {
    const Difference& first = *field.first;
    const std::string unit = field.unit.empty() ? "" : " [" + field.unit + "]";
    std::printf("        A %s%s (%s)\n        B %s%s (%s)\n", printable(first.value_a).c_str(), unit.c_str(),
                place(first.a).c_str(), printable(first.value_b).c_str(), unit.c_str(),
                place(first.b).c_str());
}

/// "A constant 25; B 79 values, 12.1 to 13.4, median 12.8; distance 0.93", "both constant 25"
std::string spreads_text(const Spread& a, const Spread& b, double distance) {
    const std::string in_a = printable(text_of(a)), in_b = printable(text_of(b));
    if (in_a == in_b && distance <= 0) return "both " + in_a;
    char text[32] = "";
    if (distance >= 0) std::snprintf(text, sizeof text, "; distance %.2f", distance);
    return "A " + in_a + "; B " + in_b + text;
}

std::string spreads_text(const FieldReport& field) {
    return spreads_text(field.spreads.a, field.spreads.b, field.spreads.distance);
}

void print_field(const FieldReport& field, bool everything) {
    const std::string name = "      " + padded(field.name, 28);
    const bool spread = field.verdict == Verdict::different || field.verdict == Verdict::alike ||
                        everything || field.is_constant_once();
    switch (field.verdict) {
        case Verdict::different:
            std::printf("%sDIFFERENT in %zu of %zu%s%s\n", name.c_str(), field.different, field.compared,
                        field.samples ? ": " : "", field.samples ? samples_text(field).c_str() : "");
            break;
        case Verdict::alike:
            std::printf("%salike: %s\n", name.c_str(), samples_text(field).c_str());
            break;
        case Verdict::equal:
            if (spread) std::printf("%sequal\n", name.c_str());
            break;
        case Verdict::not_compared:
            if (spread) std::printf("%snot compared\n", name.c_str());
            break;
    }
    if (spread) std::printf("        %s\n", spreads_text(field).c_str());
    if (field.verdict != Verdict::different) return;
    if (field.largest > 0) std::printf("        at most by %s\n", rounded(field.largest).c_str());
    if (field.first) print_first(field);
}

void print_places(const char* title, const std::vector<Place>& places) {
    constexpr std::size_t shown = 5;
    for (std::size_t i = 0; i < std::min(shown, places.size()); ++i)
        std::printf("      %s: %s\n", title, place(places[i]).c_str());
    if (places.size() > shown) std::printf("      %s: %zu more\n", title, places.size() - shown);
}

/// "40 values, 24.1 to 26.3, median 25, 95 % up to 25.9, deviation 0.4", of times in ms.
std::string times_text(const Spread& s) {
    if (s.count == 0) return "none";
    const auto ms = [](double seconds) { return rounded(1000 * seconds); };
    if (s.distinct == 1) return "constant " + ms(s.least);
    return std::to_string(s.distinct) + " values, " + ms(s.least) + " to " + ms(s.most) + ", median " +
           ms(s.median) + ", 95 % up to " + ms(s.p95) + ", deviation " + ms(s.deviation);
}

void print_times(const char* what, const Spread& a, const Spread& b) {
    if (a.count == 0 && b.count == 0) return;
    std::printf("      %s, ms:\n        A %s\n        B %s\n", what, times_text(a).c_str(),
                times_text(b).c_str());
}

std::size_t count(const TypeReport& type, Verdict verdict) {
    return static_cast<std::size_t>(std::count_if(
        type.fields.begin(), type.fields.end(), [&](const FieldReport& f) { return f.verdict == verdict; }));
}

void print_type(const TypeReport& type, bool everything) {
    std::printf("    %s: %zu in A, %zu in B; fields equal %zu, different %zu, alike %zu, not compared %zu\n",
                printable(type.name).c_str(), type.a, type.b, count(type, Verdict::equal),
                count(type, Verdict::different), count(type, Verdict::alike),
                count(type, Verdict::not_compared));
    print_places("only in A", type.only_a);
    print_places("only in B", type.only_b);
    for (const FieldReport& field : type.fields) print_field(field, everything);
    print_times("from one to the next", type.gap_a, type.gap_b);
    print_times("from one to the next by their own clock", type.own_gap_a, type.own_gap_b);
    print_times("until the other side speaks", type.answer_a, type.answer_b);
}

void print_direction(const DirectionReport& direction, bool everything) {
    const auto who = [](const std::string& name) {
        return name.empty() ? std::string("nobody") : printable(name);
    };
    std::printf("  %s  A: %s  B: %s\n",
                direction.family.empty() ? "no known protocol" : direction.family.c_str(),
                who(direction.a).c_str(), who(direction.b).c_str());
    if (direction.undecoded_a + direction.undecoded_b > 0)
        std::printf("    not decoded: %zu bytes in A, %zu in B\n", direction.undecoded_a,
                    direction.undecoded_b);
    for (const TypeReport& type : direction.types) print_type(type, everything);
    std::printf("\n");
}

/// "HeadData: gain, ad_low; 2 only in A"
void print_summary(const Report& report) {
    for (const DirectionReport& direction : report.directions)
        for (const TypeReport& type : direction.types) {
            if (!type.differs()) continue;
            std::string text;
            for (const FieldReport& field : type.fields)
                if (field.verdict == Verdict::different) text += (text.empty() ? "" : ", ") + field.name;
            const auto more = [&text](std::size_t number, const char* where) {
                if (number > 0) text += (text.empty() ? "" : "; ") + std::to_string(number) + where;
            };
            more(type.only_a.size(), " only in A");
            more(type.only_b.size(), " only in B");
            std::printf("  %s %s: %s\n", direction.family.c_str(), printable(type.name).c_str(),
                        text.c_str());
        }
}

void print_constants(const Report& report) {
    bool first = true;
    for (const DirectionReport& direction : report.directions)
        for (const TypeReport& type : direction.types)
            for (const FieldReport& field : type.fields) {
                if (!field.is_constant_once()) continue;
                if (first) std::printf("constant on one side only:\n");
                first = false;
                std::printf("  %s %s.%s: %s\n", direction.family.c_str(), printable(type.name).c_str(),
                            field.name.c_str(), spreads_text(field).c_str());
            }
}

}  // namespace

void print(const Report& report, bool everything) {
    std::printf("A %s: %s\nB %s: %s\n\n", report.file_a.c_str(),
                counted(report.messages_a, "message").c_str(), report.file_b.c_str(),
                counted(report.messages_b, "message").c_str());
    for (const DirectionReport& direction : report.directions) print_direction(direction, everything);
    std::printf("%s\n", report.differs() ? "different:" : "equal, but for what differs by nature");
    print_summary(report);
    print_constants(report);
}

}  // namespace echoloop::diff
