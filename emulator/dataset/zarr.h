// Zarr v2 on a disk, as its specification says: groups, and arrays of which each ping is a chunk.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "emulator/dataset/place.h"

namespace echoloop::zarr {

/// Throws DatasetFault, as everything here.
void put_group(DatasetPlace& place, const std::string& name);

/// An array in C order whose first dimension counts the pings.
class Array {
  public:
    enum class Type { float32, uint16 };

    /// `shape`: of one ping.
    Array(std::string name, std::vector<std::size_t> shape, Type type)
        : name_(std::move(name)), shape_(std::move(shape)), type_(type) {}

    /// The next ping's numbers, as they are in memory.
    void add(DatasetPlace& place, std::string_view numbers);
    /// Its description; nothing is added after it. `dimensions`: names, as xarray wants them.
    void finish(DatasetPlace& place, const nlohmann::ordered_json& attributes) const;

    const std::string& name() const { return name_; }
    std::size_t pings() const { return pings_; }

  private:
    std::string name_;
    std::vector<std::size_t> shape_;
    Type type_;
    std::size_t pings_ = 0;
};

}  // namespace echoloop::zarr
