// What became of a world: what went into the scene, of which material and why, and what was left out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace echoloop::worlds {

struct ReportRow {
    std::string model, material;
    std::string from;  ///< kind of the clue, and the clue: `visual "hull"`
    bool guessed = false;
    std::size_t meshes = 0, triangles = 0;
};

struct Report {
    std::vector<ReportRow> rows{};
    std::vector<std::string> movers{};    ///< names of nodes that can move
    std::vector<std::string> left_out{};  ///< one line each, with the reason
    std::vector<std::string> notes{};
    std::size_t models = 0;
    double seconds = 0;

    /// Of one surface; those of one model, material and kind of clue are one row.
    void add(const ReportRow& row);
    std::string text(const std::string& file) const;
    std::string json(const std::string& file) const;
};

}  // namespace echoloop::worlds
