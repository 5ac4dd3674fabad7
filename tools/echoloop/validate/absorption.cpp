// V2: the two published equations at their check values, and the table of both.
#include <cstdio>
#include <optional>

#include "render/water.h"
#include "tools/echoloop/validate/groups.h"

namespace echoloop::validation {
namespace {

Water water(double temperature, double salinity, double depth, double ph) {
    Water w;
    w.temperature = temperature;
    w.salinity = salinity;
    w.depth = depth;
    w.ph = ph;
    return w;
}

struct Row {
    double kilohertz, francois_garrison, ainslie_mccolm;
};

/// The table has three figures at least, so half a unit of the last is its tolerance.
void check_table(Findings& find, const char* where, const Water& w, std::initializer_list<Row> rows) {
    const auto half_unit = [](double value) {
        return value < 10 ? 0.0051 : value < 60 ? 0.051 : value < 450 ? 0.06 : 0.6;
    };
    for (const Row& row : rows) {
        char name[80];
        std::snprintf(name, sizeof name, "Francois-Garrison, %s, %.0f kHz", where, row.kilohertz);
        find.within(name, "dB/km", row.francois_garrison, half_unit(row.francois_garrison),
                    absorption_db_per_km(w, row.kilohertz * 1e3));
        std::snprintf(name, sizeof name, "Ainslie-McColm, %s, %.0f kHz", where, row.kilohertz);
        find.within(name, "dB/km", row.ainslie_mccolm, half_unit(row.ainslie_mccolm),
                    ainslie_mccolm_db_per_km(w, row.kilohertz * 1e3));
    }
}

}  // namespace

void check_absorption(Findings& find) {
    find.source("Francois & Garrison, JASA 72 (1982) 1879, check values", Kind::published);
    Water given_speed = water(10, 35, 0, 8);
    given_speed.sound_speed = 1500;
    const struct {
        const char* name;
        Water water;
        double kilohertz, published;
    } values[] = {{"200 kHz", water(10, 35, 0, 8), 200, 54.446199},
                  {"200 kHz, c given as 1500 m/s", given_speed, 200, 54.047064},
                  {"200 kHz, 4000 m", water(10, 35, 4000, 8), 200, 32.836398},
                  {"31.23 kHz", water(10, 35, 0, 8), 31.23, 7.354640},
                  {"200 kHz, pH 7.8", water(10, 35, 0, 7.8), 200, 54.411284},
                  {"200 kHz, S 15.000012", water(10, 15.000012, 0, 8), 200, 31.259585},
                  {"200 kHz, 0.2 C", water(0.2, 35, 0, 8), 200, 40.702235}};
    for (const auto& v : values)
        find.within(v.name, "dB/km", v.published, 1e-5, absorption_db_per_km(v.water, v.kilohertz * 1e3));
    find.source("Ainslie & McColm, JASA 103 (1998) 1671", Kind::published);
    find.within("Ainslie-McColm, 700 kHz, 20 C, 1 m, pH 8.1", "dB/m", 0.2146, 5e-5,
                ainslie_mccolm_db_per_km(water(20, 35, 1, 8.1), 700e3) / 1e3);
    find.source("computed from both equations");
    check_table(find, "sea 10 C", water(10, 35, 0, 8),
                {{30, 6.87, 7.02},
                 {120, 38.8, 39.7},
                 {200, 54.4, 56.1},
                 {330, 79.5, 83.0},
                 {450, 109.7, 115.8},
                 {750, 222.4, 238.4},
                 {900, 299.5, 322.3},
                 {1200, 495, 536},
                 {2250, 1621, 1761}});
    check_table(find, "fresh 15 C", water(15, 0, 5, 8),
                {{115, 3.43, 3.72}, {450, 52.5, 56.9}, {750, 146.0, 158.1}, {900, 210.2, 227.7}});
}

}  // namespace echoloop::validation
