// Numbers as the files of a data set hold them: little endian, squeezed, as an image, as a sum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace echoloop {

/// The bytes of numbers in memory.
template <typename Number>
std::string_view bytes_of(std::span<const Number> numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

/// zlib's format (RFC 1950) at its quickest level.
std::string squeezed(std::string_view bytes);

/// The first bytes of all elements, then the second ones and so on: the filter `shuffle` of numcodecs.
std::string shuffled(std::string_view bytes, std::size_t element);

/// A 16-bit grey PNG, its rows from the top; throws std::bad_alloc.
std::string grey_png(std::span<const std::uint16_t> pixels, std::size_t width, std::size_t height);

/// SHA-256 of pieces, in hexadecimal digits.
std::string sha256(std::span<const std::string_view> pieces);

/// Every number as JSON writes it, with commas between.
void append_numbers(std::string& text, std::span<const std::size_t> numbers);

}  // namespace echoloop
