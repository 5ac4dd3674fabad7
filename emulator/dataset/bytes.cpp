#include "emulator/dataset/bytes.h"

#include <openssl/evp.h>
#include <png.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <charconv>
#include <memory>
#include <new>
#include <utility>

namespace echoloop {

static_assert(std::endian::native == std::endian::little);

std::string squeezed(std::string_view bytes) {
    uLongf size = compressBound(bytes.size());
    std::string out(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                  bytes.size(), Z_BEST_SPEED) != Z_OK)
        throw std::bad_alloc();
    out.resize(size);
    return out;
}

std::string shuffled(std::string_view bytes, std::size_t element) {
    const std::size_t count = bytes.size() / element;
    std::string out(bytes.size(), '\0');
    for (std::size_t part = 0; part < element; ++part)
        for (std::size_t i = 0; i < count; ++i) out[part * count + i] = bytes[i * element + part];
    return out;
}

std::string grey_png(std::span<const std::uint16_t> pixels, std::size_t width, std::size_t height) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = PNG_FORMAT_LINEAR_Y;
    image.flags = PNG_IMAGE_FLAG_FAST;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string out(size, '\0');
    if (png_image_write_to_memory(&image, out.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
        throw std::bad_alloc();
    out.resize(size);
    return out;
}

std::string sha256(std::span<const std::string_view> pieces) {
    const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    bool good = context != nullptr && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
    for (const std::string_view piece : pieces)
        good = good && EVP_DigestUpdate(context.get(), piece.data(), piece.size()) == 1;
    if (!good || EVP_DigestFinal_ex(context.get(), digest.data(), &size) != 1) throw std::bad_alloc();
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
        constexpr std::string_view digits = "0123456789abcdef";
        text += digits[digest[i] >> 4], text += digits[digest[i] & 15];
    }
    return text;
}

void append_numbers(std::string& text, std::span<const std::size_t> numbers) {
    char buffer[24];
    for (bool first = true; const std::size_t number : numbers) {
        if (!std::exchange(first, false)) text += ',';
        text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr);
    }
}

}  // namespace echoloop
