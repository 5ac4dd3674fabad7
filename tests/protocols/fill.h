// Fills any message that has a layout with arbitrary content whose counts agree, by walking its table. The
// numbers come from a Source: `template <class T> T number()` for integers and `std::size_t size()` for
// counts.
#pragma once

#include <map>
#include <string_view>

#include "protocols/wire/layout.h"

namespace echoloop::wire {

template <class Source>
class Filler {
  public:
    explicit Filler(Source& source) : source_(source) {}

    template <class M>
    void message(M& message) {
        std::apply([&](const auto&... fields) { (field(message, fields), ...); }, layout<M>.fields);
    }

  private:
    template <class T>
    void value(T& out) {
        if constexpr (HasLayout<T>) {
            message(out);
        } else if constexpr (std::is_enum_v<T>) {
            out = static_cast<T>(source_.template number<std::underlying_type_t<T>>());
        } else if constexpr (std::is_floating_point_v<T>) {
            out = static_cast<T>(source_.template number<std::int32_t>()) / T(1024);
        } else if constexpr (Scalar<T>) {
            out = source_.template number<T>();
        } else if constexpr (is_text<T>) {
            for (char& c : out.chars)
                c = static_cast<char>('!' + source_.template number<std::uint8_t>() % 90);
        } else {
            for (auto& item : out) value(item);
        }
    }
    template <class V>
    void vector(V& out, std::size_t size) {
        out.resize(size);
        for (auto& item : out) value(item);
    }
    std::size_t count(std::string_view key) {
        const auto [at, fresh] = counts_.try_emplace(key, 0);
        if (fresh) at->second = source_.size();
        return at->second;
    }

    template <class M, class T>
    void field(M& m, const Member<M, T>& f) {
        value(m.*f.member);
    }
    template <class M, class T>
    void field(M& m, const CountMember<M, T>& f) {
        m.*f.member = static_cast<T>(count(f.key));
    }
    template <class M, class V>
    void field(M& m, const Counted<M, V>& f) {
        const std::size_t times = f.count.times.empty() ? 1 : count(f.count.times);
        vector(m.*f.member, (count(f.count.key) * times + f.count.per - 1) / f.count.per);
    }
    template <class M>
    void field(M& m, const Rest<M>& f) {
        vector(m.*f.member, f.sizes[source_.size() % 2]);
    }
    template <class M, class T>
    void field(M& m, const Section<M, T>& f) {
        section(m.*f.member);
    }
    template <class T>
    void section(T& body) {
        message(body);
    }
    template <class T>
    void section(std::optional<T>& body) {
        if (source_.size() % 2 == 0) return;
        message(body.emplace());
    }
    template <class... T>
    void section(std::variant<T...>& body) {
        alternative(body, source_.size() % sizeof...(T));
        std::visit([&](auto& chosen) { message(chosen); }, body);
    }
    template <class... T>
    static void alternative(std::variant<T...>& body, std::size_t index) {
        std::size_t n = 0;
        ((n++ == index ? void(body = T{}) : void()), ...);
    }
    template <class M, class V>
    void field(M& m, const List<M, V>& f) {
        vector(m.*f.member, source_.size());
    }
    template <class M, class V>
    void field(M& m, const TaggedList<M, V>& f) {
        (m.*f.member).resize(source_.size() % 6);
        for (auto& item : m.*f.member) {
            alternative(item, source_.size() % std::variant_size_v<typename V::value_type>);
            std::visit([&](auto& chosen) { tagged(chosen); }, item);
        }
    }
    template <class T>
    void tagged(T& body) {
        if constexpr (HasLayout<T>) {
            message(body);
        } else {
            body.name = "XYZ3";
            vector(body.words, 3);
        }
    }
    /// Constants, magic, derived counts and sizes have nothing to fill.
    template <class M, class Field>
    void field(M&, const Field&) {}

    Source& source_;
    std::map<std::string_view, std::size_t> counts_;
};

}  // namespace echoloop::wire
