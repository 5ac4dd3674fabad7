#include <algorithm>

#include "emulator/contract/model.h"
#include "emulator/devices/altimeters/altimeters.h"
#include "emulator/devices/aris/aris.h"
#include "emulator/devices/dvl-wayfinder/dvl.h"
#include "emulator/devices/edgetech-2205/edgetech_2205.h"
#include "emulator/devices/imagenex-831l/profiler.h"
#include "emulator/devices/imagenex-852/sounder.h"
#include "emulator/devices/imagenex-872/imagenex_872.h"
#include "emulator/devices/imagenex-881a/sonar.h"
#include "emulator/devices/imagenex-deltat/delta_t.h"
#include "emulator/devices/kongsberg-kmall/kongsberg.h"
#include "emulator/devices/micron-echosounder/echosounder.h"
#include "emulator/devices/nmea-echosounder/echosounder.h"
#include "emulator/devices/nmea-ins/ins.h"
#include "emulator/devices/norbit-wbms/norbit_wbms.h"
#include "emulator/devices/nortek-dvl/models.h"
#include "emulator/devices/nortek-nucleus/models.h"
#include "emulator/devices/oculus/oculus.h"
#include "emulator/devices/omniscan450/omniscan450.h"
#include "emulator/devices/ping1d/ping1d.h"
#include "emulator/devices/ping360/ping360.h"
#include "emulator/devices/r2sonic/r2sonic.h"
#include "emulator/devices/reson-7k/reson7k.h"
#include "emulator/devices/s500/s500.h"
#include "emulator/devices/sonar-3d-15/sonar.h"
#include "emulator/devices/surveyor240/surveyor240.h"
#include "emulator/devices/teledyne-dvl/models.h"
#include "emulator/devices/tritech-micron/micron.h"
#include "emulator/devices/tritech-profiler/profiler.h"
#include "emulator/devices/tritech-seaking/seaking.h"
#include "emulator/devices/waterlinked-dvl/models.h"
#include "protocols/checksums.h"

namespace echoloop {
namespace {

// An explicit table: a self-registering object in a static library would silently be dropped by the linker.
std::vector<Model> make_models() {
    std::vector<Model> all;
    for (Model& model : altimeters::models()) all.push_back(std::move(model));
    for (Model& model : aris_device::models()) all.push_back(std::move(model));
    all.push_back(imagenex852::model());
    all.push_back(imagenex881a::model());
    all.push_back(delta_t::model());
    all.push_back(kongsberg_kmall::model());
    all.push_back(micron::model());
    all.push_back(profiler::model());
    all.push_back(seaking::model());
    all.push_back(nmea_echosounder::model());
    all.push_back(nmea_ins::model());
    all.push_back(norbit_device::model());
    for (Model& model : nortek_dvl::models()) all.push_back(std::move(model));
    all.push_back(nortek_nucleus::model());
    for (Model& model : oculus_device::models()) all.push_back(std::move(model));
    all.push_back(omniscan450::model());
    all.push_back(ping1d::model());
    all.push_back(ping360::model());
    for (Model& model : r2sonic_device::models()) all.push_back(std::move(model));
    all.push_back(sonar_3d_15::model());
    all.push_back(reson7k_device::model());
    all.push_back(surveyor240::model());
    all.push_back(micron_echosounder::model());
    all.push_back(s500::model());
    for (Model& model : teledyne_dvl::models()) all.push_back(std::move(model));
    for (Model& model : waterlinked_dvl::models()) all.push_back(std::move(model));
    all.push_back(edgetech_2205::model());
    all.push_back(imagenex872::model());
    all.push_back(dvl_wayfinder::model());
    all.push_back(imagenex831l::model());
    for (Model& model : all) model.has_checksums = find_checksums(model.family) != nullptr;
    std::sort(all.begin(), all.end(), [](const Model& a, const Model& b) { return a.name < b.name; });
    return all;
}

}  // namespace

std::span<const Model> models() {
    static const std::vector<Model> all = make_models();
    return all;
}

const Model* find_model(std::string_view name) {
    for (const Model& model : models())
        if (model.name == name) return &model;
    return nullptr;
}

}  // namespace echoloop
