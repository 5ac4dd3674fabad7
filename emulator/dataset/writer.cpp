#include "emulator/dataset/writer.h"

#include <nlohmann/json.hpp>

#include "emulator/dataset/labels.h"

namespace echoloop {

DatasetWriter::DatasetWriter(DatasetPlace& place, DatasetStart start)
    : place_(place), start_(std::move(start)), eyes_(start_.scene), files_(place) {
    zarr::put_group(place_, "echogram.zarr");
    files_.truth.append(truth_header_line(start_.header) + "\n");
    for (std::size_t i = 0; i < start_.turns.size(); ++i)
        sonars_.emplace_back(files_, start_.header.devices[i].name, start_.turns[i]);
}

void DatasetWriter::heard(std::size_t sonar, PingTruth ping) {
    const Echogram& echo = ping.echo;
    const Look look =
        eyes_.look(echo.shot, echo.world_from_sonar, ping.movers, end_range(echo), turn_within(ping));
    if (start_.straight) keep_main_lobes(look, ping);
    for (const ObjectInView& object : look.objects)
        ping.visible.emplace_back(object.object + 1, object.seen / object.whole);
    sonars_[sonar].heard(std::move(ping), look);
    ++pings_;
}

void DatasetWriter::finish(std::uint64_t lost) {
    for (SonarSet& sonar : sonars_) sonar.finish();
    files_.coco.finish(*start_.scene);
    const nlohmann::ordered_json all{{"echoloop_dataset", 1},
                                     {"pings", pings_},
                                     {"lost", lost},
                                     {"labels", start_.straight ? "main lobes" : "main and side lobes"}};
    place_.put("dataset.json", all.dump() + "\n");
}

}  // namespace echoloop
