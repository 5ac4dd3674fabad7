// The counts that the arrays of a message imply, found before it is written. Reads messages, never bytes.
#pragma once

#include <algorithm>
#include <limits>
#include <variant>

#include "protocols/wire/counts.h"
#include "protocols/wire/layout.h"

namespace echoloop::wire {

/// The first array of a key decides its count; a count member decides where no array does (a product of two
/// counts).
class CountCollector {
  public:
    template <class M>
    void message(const M& message) {
        std::apply([&](const auto&... fields) { (field(message, fields), ...); }, layout<M>.fields);
    }

    std::uint64_t get(std::string_view key) const {
        const std::uint64_t count = arrays_.get(key);
        return count != Counts::unknown ? count : members_.get(key);
    }
    /// Elements that `ref` asks for.
    std::uint64_t elements(const CountRef& ref) const {
        Counts both;
        both.set(ref.key, get(ref.key));
        if (!ref.times.empty()) both.set(ref.times, get(ref.times));
        return both.elements(ref);
    }

  private:
    template <class M, class Wire>
    void field(const M&, const Count<Wire>& count) {
        std::uint64_t most = 0xFFFF;
        if constexpr (!std::is_same_v<Wire, HexDigits4>) most = std::numeric_limits<Wire>::max();
        limits_.set(count.key, most - static_cast<std::uint64_t>(count.bias));
    }
    template <class M, class T>
    void field(const M& message, const CountMember<M, T>& count) {
        limits_.set(count.key, std::numeric_limits<T>::max());
        members_.set(count.key, message.*count.member);
    }
    template <class M, class V>
    void field(const M& message, const Counted<M, V>& array) {
        const std::uint64_t size = (message.*array.member).size();
        if (array.count.is_identity())
            arrays_.set(array.count.key, std::min(size, limits_.get(array.count.key)));
    }
    template <class M, class T>
    void field(const M& message, const Member<M, T>& nested) {
        if constexpr (HasLayout<T>) this->message(message.*nested.member);
    }
    template <class M, class T>
    void field(const M& message, const Section<M, T>& section) {
        const T& value = message.*section.member;
        if constexpr (is_variant<T>) {
            std::visit([&](const auto& body) { this->message(body); }, value);
        } else if constexpr (is_optional<T>) {
            if (value) this->message(*value);
        } else {
            this->message(value);
        }
    }
    /// All other kinds hold no counts.
    template <class M, class Field>
    void field(const M&, const Field&) {}

    Counts limits_;
    Counts arrays_;
    Counts members_;
};

}  // namespace echoloop::wire
