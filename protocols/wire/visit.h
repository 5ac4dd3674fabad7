// `visit_fields(message, visitor)`: every field of a message as a FieldView, in wire order. Writes and
// allocates no bytes of the wire.
#pragma once

#include <utility>

#include "protocols/wire/collect.h"
#include "protocols/wire/layout.h"
#include "protocols/wire/value.h"

namespace echoloop::wire {

template <class Visitor>
class FieldWalk {
  public:
    FieldWalk(Visitor& visitor, std::size_t base) : visitor_(visitor), position_(base), start_(base) {}

    template <class M>
    void message(const M& message) {
        counts_.message(message);
        fields(message);
    }

  private:
    template <class M>
    void fields(const M& message) {
        std::apply([&](const auto&... each) { (field(message, each), ...); }, layout<M>.fields);
    }

    /// The fields of a struct, their names prefixed.
    template <class M>
    void group(const M& message, const std::string& name) {
        const std::size_t length = prefix_.size();
        prefix_.append(name).append(".");
        fields(message);
        prefix_.resize(length);
    }

    void emit(const Meta& meta, std::span<const NamedValue> names, std::size_t size, Value value) {
        FieldView view{
            prefix_ + std::string(meta.name),        meta.unit,       meta.help, position_, size, meta.format,
            meta.names.empty() ? names : meta.names, std::move(value)};
        position_ += size;
        visitor_(std::as_const(view));
    }

    template <class T>
    void emit_value(const Meta& meta, const T& value) {
        if constexpr (HasLayout<T>) {
            group(value, std::string(meta.name));
        } else if constexpr (Scalar<T>) {
            emit(meta, value_names<T>, sizeof(T), scalar(value));
        } else if constexpr (is_text<T>) {
            emit(meta, {}, sizeof(T::chars), std::string(value.view()));
        } else {
            emit(meta, {}, *fixed_size<T>(), numbers(value));
        }
    }

    template <Scalar T>
    static Value scalar(T value) {
        if constexpr (std::is_floating_point_v<T>) {
            return readable(value);
        } else if constexpr (std::is_signed_v<T>) {
            return static_cast<std::int64_t>(value);
        } else {
            return static_cast<std::uint64_t>(value);  // an enum too
        }
    }

    template <class V>
    static std::vector<double> numbers(const V& values) {
        std::vector<double> out;
        out.reserve(values.size());
        for (const auto value : values) out.push_back(readable(value));
        return out;
    }

    template <class V>
    void emit_vector(const Meta& meta, const V& values) {
        using T = typename V::value_type;
        if constexpr (Scalar<T>) {
            emit(meta, {}, values.size() * sizeof(T), numbers(values));
        } else {
            std::size_t index = 0;
            for (const T& item : values) {
                group(item, std::string(meta.name) + '[' + std::to_string(index++) + ']');
            }
        }
    }

    template <class M, class T>
    void field(const M& message, const Member<M, T>& f) {
        emit_value(f.meta, message.*f.member);
    }
    template <class M, class Wire>
    void field(const M&, const Count<Wire>& f) {
        const std::uint64_t raw = counts_.get(f.key) + static_cast<std::uint64_t>(f.bias);
        emit(f.meta, {}, *field_size(f), raw);
    }
    template <class M, class T>
    void field(const M&, const CountMember<M, T>& f) {
        emit(f.meta, {}, sizeof(T), counts_.get(f.key));
    }
    template <class M, class V>
    void field(const M& message, const Counted<M, V>& f) {
        emit_vector(f.meta, message.*f.member);
    }
    template <class M, class T>
    void field(const M&, const Constant<T>& f) {
        emit_value(f.meta, f.value);
    }
    template <class M>
    void field(const M&, const Magic& f) {
        emit(f.meta, {}, f.value.size(), std::string(f.value));
    }
    /// Not shown: it is the number of bytes that whoever has the message already knows.
    template <class M, class T>
    void field(const M&, const TotalSize<T>&) {
        position_ += sizeof(T);
    }
    template <class M>
    void field(const M& message, const Rest<M>& f) {
        emit_vector(f.meta, message.*f.member);
    }

    template <class T>
    void section(const T& body, const std::string& name) {
        position_ += 4;
        group(body, name);
        position_ += (4 - (position_ - start_) % 4) % 4;
    }
    template <class M, class T>
    void field(const M& message, const Section<M, T>& f) {
        const T& value = message.*f.member;
        const std::string name(f.meta.name);
        if constexpr (is_variant<T>) {
            std::visit([&]<class B>(const B& body) { section(body, std::string(layout<B>.tag)); }, value);
        } else if constexpr (is_optional<T>) {
            if (value) section(*value, name);
        } else {
            section(value, name);
        }
    }
    template <class M, class V>
    void field(const M& message, const List<M, V>& f) {
        emit_vector(f.meta, message.*f.member);
    }
    template <class M, class V>
    void field(const M& message, const TaggedList<M, V>& f) {
        const auto one = [&]<class T>(const T& item) {
            position_ += 4;
            if constexpr (HasLayout<T>) {
                group(item, std::string(layout<T>.tag));
            } else {
                emit({item.name.view(), "", "unknown section"}, {}, item.words.size() * 4,
                     numbers(item.words));
            }
        };
        for (const auto& item : message.*f.member) std::visit(one, item);
    }

    Visitor& visitor_;
    std::size_t position_;
    std::size_t start_;
    std::string prefix_;
    CountCollector counts_;
};

/// Calls visitor(const FieldView&) for every field, members of nested structs included. Sizes and tags of
/// sections and the size of the whole message are not fields.
template <class M, class Visitor>
void visit_fields(const M& message, Visitor&& visitor) {
    FieldWalk<std::remove_reference_t<Visitor>>(visitor, layout<M>.base).message(message);
}

}  // namespace echoloop::wire
