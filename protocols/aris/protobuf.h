// Protobuf for structs that have a table of Fields: absent fields are 0, unknown ones are skipped, of a field
// that comes twice the last counts. Allocates no more than the bytes that are there.
#pragma once

#include <optional>
#include <type_traits>

#include "protocols/aris/fields.h"

namespace echoloop::aris::protobuf {

enum Kind : std::uint32_t { varint = 0, fixed64 = 1, block = 2, fixed32 = 5 };

template <class T>
inline constexpr bool is_part = false;
template <class T>
inline constexpr bool is_part<std::optional<T>> = true;
template <class T>
inline constexpr bool is_names = std::is_same_v<T, std::vector<std::string>>;

/// How a member stands on the wire.
template <class T>
constexpr Kind kind_of() {
    if constexpr (std::is_same_v<T, float>) return fixed32;
    return std::is_integral_v<T> ? varint : block;
}

/// Takes one thing after another; `good` is false from the first that is not there.
class Taker {
  public:
    explicit Taker(wire::ByteView bytes) : left_(bytes) {}

    bool good() const { return good_; }
    bool more() const { return good_ && !left_.empty(); }
    /// 64 bits; ten bytes at most.
    std::uint64_t number();
    wire::ByteView bytes(std::uint64_t count);
    wire::ByteView sized() { return bytes(number()); }
    void skip(std::uint32_t kind);
    void fail() { good_ = false; }

  private:
    wire::ByteView left_;
    bool good_ = true;
};

void put_number(std::uint64_t value, wire::Bytes& out);
void put_sized(wire::ByteView bytes, wire::Bytes& out);
void put_float(float value, wire::Bytes& out);

template <class M>
void write(const M& message, wire::Bytes& out);
template <class M>
bool read(wire::ByteView bytes, M& message);

template <class T>
bool is_absent(const T& value) {
    if constexpr (is_part<T>)
        return !value;
    else if constexpr (kind_of<T>() == block)
        return value.empty();
    else
        return value == T{} && !std::is_same_v<T, float>;
}

/// A float that is plus zero is absent; minus zero and NaN are not.
template <>
inline bool is_absent(const float& value) {
    return std::bit_cast<std::uint32_t>(value) == 0;
}

inline wire::ByteView view(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

template <class T>
void write_value(const T& value, wire::Bytes& out) {
    if constexpr (std::is_same_v<T, float>) {
        put_float(value, out);
    } else if constexpr (std::is_integral_v<T>) {
        put_number(value, out);
    } else if constexpr (is_part<T>) {
        wire::Bytes part;
        write(*value, part);
        put_sized(part, out);
    } else if constexpr (std::is_same_v<T, std::string>) {
        put_sized(view(value), out);
    } else {
        put_sized(value, out);
    }
}

template <class M, class T>
void write_field(const M& message, const Field<M, T>& field, wire::Bytes& out) {
    const T& value = message.*field.member;
    if (is_absent(value) && !field.always) return;
    const auto write_one = [&](const auto& one) {
        put_number(std::uint64_t{field.number} << 3 | kind_of<T>(), out);
        write_value(one, out);
    };
    if constexpr (is_names<T>) {
        for (const std::string& name : value) write_one(name);
    } else {
        write_one(value);
    }
}

template <class M>
void write(const M& message, wire::Bytes& out) {
    std::apply([&](const auto&... field) { (write_field(message, field, out), ...); }, Fields<M>::rows);
}

template <class T>
void read_value(Taker& from, T& value) {
    if constexpr (std::is_same_v<T, float>) {
        const wire::ByteView bits = from.bytes(4);
        if (from.good()) value = wire::load<wire::ByteOrder::little, float>(bits.data());
    } else if constexpr (std::is_same_v<T, bool>) {
        value = from.number() != 0;
    } else if constexpr (std::is_integral_v<T>) {
        value = static_cast<T>(from.number());
    } else if constexpr (is_part<T>) {
        const wire::ByteView part = from.sized();
        if (from.good() && !read(part, value.emplace())) from.fail();
    } else if constexpr (is_names<T>) {
        const wire::ByteView text = from.sized();
        value.emplace_back(text.begin(), text.end());
    } else {
        const wire::ByteView bytes = from.sized();
        value.assign(bytes.begin(), bytes.end());
    }
}

/// False if the bytes are no protobuf message, or a part of them is none.
template <class M>
bool read(wire::ByteView bytes, M& message) {
    Taker from(bytes);
    while (from.more()) {
        const std::uint64_t key = from.number();
        const auto kind = static_cast<std::uint32_t>(key & 7);
        const auto take = [&]<class T>(const Field<M, T>& field) {
            if (key >> 3 != field.number || kind != kind_of<T>()) return false;
            read_value(from, message.*field.member);
            return true;
        };
        if (key >> 3 == 0) return false;
        if (!std::apply([&](const auto&... field) { return (take(field) || ...); }, Fields<M>::rows))
            from.skip(kind);
    }
    return from.good();
}

}  // namespace echoloop::aris::protobuf
