#include "emulator/dataset/place.h"

#include "emulator/contract/error.h"

namespace echoloop {
namespace {

/// A folder's file that cannot be made is as bad as a disk that is full.
DiskFile opened(const std::filesystem::path& path) try {
    return DiskFile(path, "");
} catch (const StartError& error) {
    throw DatasetFault(error.what());
}

}  // namespace

void DatasetPlace::fail(const std::filesystem::path& file, const std::string& why) {
    throw DatasetFault(file.string() + ": " + why);
}

std::filesystem::path DatasetPlace::file(const std::string& name) {
    const auto path = root_ / name;
    const auto folder = path.parent_path();
    if (folder != made_) {
        std::error_code error;
        std::filesystem::create_directories(folder, error);
        if (error) fail(folder, error.message());
        made_ = folder;
    }
    return path;
}

void DatasetPlace::put(const std::string& name, std::string_view bytes) {
    DatasetStream(*this, name).append(bytes);
}

DatasetStream::DatasetStream(DatasetPlace& place, const std::string& name)
    : place_(place), path_(place.file(name)), file_(opened(path_)) {}

void DatasetStream::append(std::string_view bytes) {
    const std::string why = file_.append(bytes, place_.keep_free_);
    if (!why.empty()) DatasetPlace::fail(path_, why);
    place_.bytes_ += bytes.size();
}

}  // namespace echoloop
