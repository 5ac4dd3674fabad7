#include "render/scene/materials.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>
#include <utility>

namespace echoloop {
namespace {

struct Row {
    const char* words;  ///< separated by spaces; the first is the name
    double density;     ///< relative to water
    double speed;       ///< of compressional waves, relative to water
    double roughness;   ///< m, rms height within a few centimetres
    double slope;       ///< rms slope of its facets in one direction
    bool lobe;          ///< what facets mirror adds to Lambert's law
    double patchiness;  ///< dB; 0: even
};

// Sediments and rock: Jensen, Kuperman, Porter & Schmidt, Computational Ocean Acoustics (2011), table 1.3, re
// 1500 m/s. Solids: Kinsler, Frey, Coppens & Sanders, Fundamentals of Acoustics (2000), appendix A10, bulk
// speed, re 1500 m/s. Roughness and slope: own choice, of the order of the grains or of the finish. Slopes of
// sediments after Jackson & Richardson, High-Frequency Seafloor Acoustics (2007). No lobe of sediments and
// rock: the intensities of a Sonic 2026 at the nadir are 3 dB above what Lambert's constant alone gives, and
// a lobe of sand with any slope is 13 dB above it or flattens the outer beams. Patchiness of sediments and
// rock: own choice within 1.5 to 3 dB, the K distributions of shape 2 to 8 that sonars show of seabeds.
constexpr Row table[] = {
    {"sand sandy", 1.9, 1.1, 0.005, 0.15, false, 2.0},                            // Jensen: sand
    {"mud muddy clay", 1.5, 1.0, 0.002, 0.075, false, 1.5},                       // Jensen: clay
    {"silt silty sediment", 1.7, 1.05, 0.003, 0.1, false, 1.5},                   // Jensen: silt
    {"gravel pebble pebbles cobble cobbles", 2.0, 1.2, 0.01, 0.35, false, 2.36},  // Jensen: gravel
    {"moraine", 2.1, 1.3, 0.02, 0.35, false, 3.0},                                // Jensen: moraine
    {"chalk", 2.2, 1.6, 0.005, 0.2, false, 2.0},                                  // Jensen: chalk
    {"limestone coral reef", 2.4, 2.0, 0.01, 0.3, false, 3.0},                    // Jensen: limestone
    {"rock rocks rocky basalt stone boulder boulders granite", 2.7, 3.5, 0.02, 0.35, false,
     3.0},                                                                           // Jensen: basalt
    {"concrete cement", 2.6, 3100.0 / 1500, 0.0003, 0.1, true, 0},                   // Kinsler: concrete
    {"steel metal metallic iron chain", 7.7, 6100.0 / 1500, 0.0001, 0.05, true, 0},  // Kinsler: steel
    {"aluminium aluminum", 2.7, 6300.0 / 1500, 0.0001, 0.05, true, 0},               // Kinsler: aluminium
    {"brass bronze", 8.5, 4700.0 / 1500, 0.0001, 0.05, true, 0},                     // Kinsler: brass
    {"copper", 8.9, 5000.0 / 1500, 0.0001, 0.05, true, 0},                           // Kinsler: copper
    {"lead", 11.3, 2050.0 / 1500, 0.0001, 0.05, true, 0},                            // Kinsler: lead
    {"glass", 2.3, 5600.0 / 1500, 0.0001, 0.03, true, 0},                            // Kinsler: Pyrex glass
    {"plastic acrylic perspex", 1.2, 2650.0 / 1500, 0.0001, 0.03, true, 0},          // Kinsler: Lucite
    {"ice", 0.92, 3200.0 / 1500, 0.001, 0.1, true, 0},                               // Kinsler: ice
    {"wood wooden timber oak", 0.72, 4000.0 / 1500, 0.0003, 0.1, true, 0},           // Kinsler: oak
    {"rubber neoprene", 1.1, 2400.0 / 1500, 0.0001, 0.05, true, 0},                  // Kinsler: hard rubber
};

double reflection(const Row& row) {
    const double z = row.density * row.speed;
    return std::abs((z - 1) / (z + 1));
}

std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words(1);
    char before = ' ';
    for (const char c : text) {
        const auto u = static_cast<unsigned char>(c);
        const bool capital_follows_small =
            std::isupper(u) && std::islower(static_cast<unsigned char>(before));
        if ((!std::isalpha(u) || capital_follows_small) && !words.back().empty()) words.emplace_back();
        if (std::isalpha(u)) words.back() += static_cast<char>(std::tolower(u));
        before = c;
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

const Row* row_of(const std::string& word) {
    for (const Row& row : table) {
        const auto names = words_of(row.words);
        if (std::find(names.begin(), names.end(), word) != names.end()) return &row;
    }
    return nullptr;
}

/// Levenshtein's distance.
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> line(b.size() + 1);
    std::iota(line.begin(), line.end(), 0U);
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(line[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] != b[j]);
            diagonal = line[j + 1];
            line[j + 1] = std::min({line[j] + 1, line[j + 1] + 1, replaced});
        }
    }
    return line.back();
}

}  // namespace

std::optional<SurfaceProperties> surface_by_name(std::string_view name) {
    for (const auto& word : words_of(name.substr(0, 256)))
        if (const Row* row = row_of(word))
            return SurfaceProperties{default_mu_db + 20 * std::log10(reflection(*row) / reflection(table[0])),
                                     reflection(*row),
                                     row->roughness,
                                     row->slope,
                                     row->lobe,
                                     row->patchiness};
    return std::nullopt;
}

std::optional<double> mu_db_by_name(std::string_view name) {
    const auto surface = surface_by_name(name);
    return surface ? std::optional(surface->mu_db) : std::nullopt;
}

std::vector<std::string> known_materials() {
    std::vector<std::string> names;
    for (const Row& row : table) names.push_back(words_of(row.words).front());
    return names;
}

std::string nearest_of(std::string_view word, const std::vector<std::string>& candidates) {
    if (word.size() > 64) return {};
    std::string best;
    std::size_t fewest = 4;
    for (const auto& candidate : candidates)
        if (const std::size_t n = edits(word, candidate); n < fewest) fewest = n, best = candidate;
    return best;
}

}  // namespace echoloop
