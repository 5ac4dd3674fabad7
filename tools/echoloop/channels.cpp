#include "tools/echoloop/channels.h"

#include <bit>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace echoloop::cli {

void write_channels_npy(const std::filesystem::path& path, const ChannelImage& image) {
    static_assert(std::endian::native == std::endian::little);
    constexpr std::size_t alignment = 64, preamble = 10;
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (3, " +
                         std::to_string(image.height) + ", " + std::to_string(image.width) + "), }";
    header.resize((preamble + header.size() + alignment) / alignment * alignment - preamble - 1, ' ');
    header += '\n';
    std::ofstream file(path, std::ios::binary);
    file.write("\x93NUMPY\x01\x00", 8);
    file.put(static_cast<char>(header.size() & 0xFF)).put(static_cast<char>(header.size() >> 8));
    file << header;
    for (const auto* channel : {&image.intensity, &image.range, &image.bearing})
        file.write(reinterpret_cast<const char*>(channel->data()),
                   static_cast<std::streamsize>(channel->size() * sizeof(float)));
    file.close();
    if (!file) throw std::runtime_error("writing failed; is the disk full?");
}

}  // namespace echoloop::cli
