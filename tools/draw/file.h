// A file that is written whole or reported; decides nothing about its content.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace echoloop::draw {

class OutputFile {
  public:
    /// Creates or empties the file. All members throw std::runtime_error with the path and the reason.
    explicit OutputFile(const std::filesystem::path& path)
        : path_(path), file_(std::fopen(path.c_str(), "wb")) {
        if (!file_) fail();
    }
    std::FILE* get() const { return file_.get(); }
    void write(const void* data, std::size_t size) {
        if (std::fwrite(data, 1, size, file_.get()) != size) fail();
    }
    /// To be called last: a full disk may show only here.
    void close() {
        if (std::fclose(file_.release()) != 0) fail();
    }
    /// What the last call of the system said is the reason.
    [[noreturn]] void fail() const {
        throw std::runtime_error("cannot write " + path_.string() + ": " + std::strerror(errno));
    }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace echoloop::draw
