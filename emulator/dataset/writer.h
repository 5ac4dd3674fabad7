// Makes and writes what a data set has of its pings, one after the other. On one thread.
#pragma once

#include <memory>
#include <vector>

#include "emulator/dataset/dataset.h"
#include "emulator/dataset/sonar_set.h"

namespace echoloop {

class DatasetWriter {
  public:
    /// Throws DatasetFault, as everything here.
    DatasetWriter(DatasetPlace& place, DatasetStart start);
    void heard(std::size_t sonar, PingTruth ping);
    void said(std::size_t sonar, std::size_t port, std::string_view bytes) {
        sonars_[sonar].said(port, bytes);
    }
    /// `lost`: pings that nobody had time for.
    void finish(std::uint64_t lost);

  private:
    DatasetPlace& place_;
    DatasetStart start_;
    VisibleObjects eyes_;
    SharedFiles files_;
    std::vector<SonarSet> sonars_;
    std::uint64_t pings_ = 0;
};

}  // namespace echoloop
