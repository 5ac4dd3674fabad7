#include "tools/import/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>

#include "tools/import/fault.h"

namespace echoloop::worlds {
namespace {

struct Sums {
    std::size_t meshes = 0, triangles = 0, taken = 0, guessed = 0;
};

/// Materials are counted by model.
Sums sums_of(const Report& report) {
    Sums out;
    for (const ReportRow& row : report.rows) {
        out.meshes += row.meshes;
        out.triangles += row.triangles;
        ++(row.guessed ? out.guessed : out.taken);
    }
    return out;
}

/// The first word of what it is from.
std::string kind_of(const ReportRow& row) { return row.from.substr(0, row.from.find(' ')); }

std::string in_columns(const std::vector<std::array<std::string, 5>>& rows) {
    std::array<std::size_t, 4> widths{};
    for (const auto& row : rows)
        for (std::size_t i = 0; i < 4; ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string out;
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::string space(widths[i] - row[i].size(), ' ');
            const bool number = i == 1 || i == 2;
            out += (number ? space + row[i] : row[i] + space) + "  ";
        }
        out += row[4] + "\n";
    }
    return out;
}

}  // namespace

void Report::add(const ReportRow& row) {
    const auto same = std::ranges::find_if(rows, [&](const ReportRow& other) {
        return other.model == row.model && other.material == row.material && kind_of(other) == kind_of(row);
    });
    if (same == rows.end()) {
        rows.push_back(row);
        return;
    }
    if (same->from != row.from && !same->from.ends_with(" ...")) same->from += " ...";
    same->meshes += row.meshes;
    same->triangles += row.triangles;
}

std::string Report::text(const std::string& file) const {
    std::vector<std::array<std::string, 5>> table{{"model", "meshes", "triangles", "material", "from"}};
    for (const ReportRow& row : rows)
        table.push_back({printable(row.model, 60), std::to_string(row.meshes), std::to_string(row.triangles),
                         row.material, row.from + (row.guessed ? " (guessed)" : "")});
    std::string out = in_columns(table);
    for (const std::string& line : left_out) out += "left out: " + line + "\n";
    for (const std::string& line : notes) out += "note: " + line + "\n";
    if (!movers.empty()) {
        out += "can move (objects: of a scenario):";
        for (const std::string& name : movers) out += " " + printable(name, 60);
        out += "\n";
    }
    const Sums sums = sums_of(*this);
    char end[256];
    std::snprintf(end, sizeof end,
                  "%zu models, %zu meshes, %zu triangles, %zu materials taken, %zu guessed, %.1f s", models,
                  sums.meshes, sums.triangles, sums.taken, sums.guessed, seconds);
    return out + printable(file, 500) + ": " + end + "\n";
}

std::string Report::json(const std::string& file) const {
    const Sums sums = sums_of(*this);
    nlohmann::ordered_json out{{"scene", file},         {"models", models},
                               {"meshes", sums.meshes}, {"triangles", sums.triangles},
                               {"taken", sums.taken},   {"guessed", sums.guessed},
                               {"seconds", seconds},    {"materials", nlohmann::ordered_json::array()}};
    for (const ReportRow& row : rows)
        out["materials"].push_back({{"model", row.model},
                                    {"meshes", row.meshes},
                                    {"triangles", row.triangles},
                                    {"material", row.material},
                                    {"from", row.from},
                                    {"guessed", row.guessed}});
    out["movers"] = movers;
    out["left_out"] = left_out;
    out["notes"] = notes;
    return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace echoloop::worlds
