// Shows protobuf messages for inspection: what any family with protobuf tables does. Knows no family.
#pragma once

#include "protocols/inspect.h"
#include "protocols/wire/protobuf.h"

namespace echoloop::inspect {

template <class T>
wire::Value protobuf_value(const T& value) {
    if constexpr (std::is_same_v<T, float>) {
        return wire::readable(value);
    } else if constexpr (std::is_signed_v<T>) {
        return std::int64_t{value};
    } else if constexpr (std::is_integral_v<T>) {
        return std::uint64_t{value};
    } else if constexpr (wire::protobuf::is_list<T>) {
        std::string all;
        for (const std::string& one : value) all += (all.empty() ? "" : " ") + one;
        return all;
    } else if constexpr (std::is_same_v<T, std::string>) {
        return value;
    } else {
        return std::vector<double>(value.begin(), value.end());
    }
}

/// Adds fields to a message. In protobuf they have no fixed place: all have that of the bytes given.
class ProtobufFields {
  public:
    /// `offset` and `size`: of the protobuf within the message.
    ProtobufFields(Message& out, std::size_t offset, std::size_t size)
        : out_(out), offset_(offset), size_(size) {}

    void add(const std::string& name, std::string_view unit, wire::Value value) {
        wire::FieldView view;
        view.name = name;
        view.unit = unit;
        view.offset = offset_;
        view.size = size_;
        view.value = std::move(value);
        out_.fields.push_back(to_field(view, out_.offset));
    }

    template <class M>
    void add_all(const M& message, const std::string& prefix = "") {
        wire::protobuf::for_each_field<M>([&]<class T>(const wire::protobuf::Field<M, T>& field) {
            const T& value = message.*field.member;
            const std::string name = prefix + std::string(field.name);
            if constexpr (wire::is_optional<T>) {
                if (value) add_all(*value, name + '.');
            } else if constexpr (wire::protobuf::is_message<T>) {
                add_all(value, name + '.');
            } else {
                add(name, field.unit, protobuf_value(value));
            }
        });
    }

  private:
    Message& out_;
    std::size_t offset_, size_;
};

template <class T>
std::string protobuf_type_name() {
    if constexpr (wire::is_optional<T>)
        return protobuf_type_name<typename T::value_type>();
    else if constexpr (wire::protobuf::is_message<T>)
        return std::string(wire::protobuf::layout<T>.name);
    else if constexpr (wire::protobuf::is_packed<T>)
        return "packed varint";
    else if constexpr (wire::protobuf::is_list<T>)
        return "strings";
    else if constexpr (std::is_integral_v<T>)
        return "varint";
    else if constexpr (std::is_same_v<T, float>)
        return "f32";
    else
        return std::is_same_v<T, std::string> ? "string" : "bytes";
}

template <class M>
wire::Table protobuf_table_of() {
    const auto& layout = wire::protobuf::layout<M>;
    wire::Table table{.name = std::string(layout.name), .help = std::string(layout.help)};
    table.help += ". Protobuf: the first column is the number of the field; fields that are 0 are absent";
    wire::protobuf::for_each_field<M>([&]<class T>(const wire::protobuf::Field<M, T>& field) {
        table.rows.push_back({.meta = {field.name, field.unit, field.help}, .type = protobuf_type_name<T>()});
        table.rows.back().offset = field.number;
    });
    return table;
}

}  // namespace echoloop::inspect
