// A file or standard input that knows its first bytes before they are read. Holds no more of it than that.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "emulator/contract/device.h"

namespace echoloop::capture {

class Input {
  public:
    /// "-" is standard input; what gzip compressed is read as if it were not. Throws StartError (no_input,
    /// no_permission) unless it is that or a regular file, and (data) if it is compressed by something else.
    explicit Input(const std::string& name);
    ~Input();
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;

    bool is_capture();  ///< begins as pcap or pcapng files do
    /// Up to `count` bytes that read() will give again.
    const Bytes& peek(std::size_t count);
    /// Up to `count` bytes; fewer only at the end. Throws StartError (io).
    Bytes read(std::size_t count);
    /// Gives the stream away, from the first byte on; for libpcap, which closes it.
    std::FILE* release();
    const std::string& name() const { return name_; }
    /// Bytes of the file, and how many of them have been read; 0 and 0 of what is no file.
    std::uint64_t size() const { return size_; }
    std::uint64_t offset() const;
    /// Why a compressed file ends early; "": it does not.
    const std::string& fault() const { return *fault_; }

  private:
    void open_compressed();

    std::unique_ptr<std::string> fault_ = std::make_unique<std::string>();
    std::string name_;
    std::FILE* file_ = nullptr;
    std::uint64_t size_ = 0;
    int watched_ = -1;  ///< shares the file's place, whoever reads it
    Bytes head_;        ///< bytes that were read ahead
};

}  // namespace echoloop::capture
