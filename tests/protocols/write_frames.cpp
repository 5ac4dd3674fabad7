// Writes frames with arbitrary content and the fields that went into them as JSON lines, for a reader that
// was written from the specifications alone (independent_reader.py).
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>

#include "protocols/r2sonic/codec.h"
#include "protocols/r2sonic/layouts.h"
#include "protocols/seanet/codec.h"
#include "protocols/seanet/layouts.h"
#include "protocols/wire/visit.h"
#include "tests/protocols/data.h"
#include "tests/protocols/fill.h"

namespace echoloop {
namespace {

struct RandomSource {
    std::mt19937_64 engine{20240607};

    template <class T>
    T number() {
        return static_cast<T>(engine());
    }
    std::size_t size() { return engine() % 40; }
};

/// The struct as JSON by its members, so that a value never passes through the bytes.
template <class M>
nlohmann::json fields_of(const M& message) {
    nlohmann::json out = nlohmann::json::object();
    wire::visit_fields(message, [&](const wire::FieldView& field) {
        std::visit([&](const auto& value) { out[field.name] = value; }, field.value);
    });
    return out;
}

void write_line(const std::string& name, const wire::Bytes& bytes, const nlohmann::json& fields) {
    std::puts(nlohmann::json{{"name", name}, {"hex", to_hex(bytes)}, {"fields", fields}}.dump().c_str());
}

template <class... M>
void write_all(std::variant<M...>*, RandomSource& source, auto encode) {
    const auto one = [&]<class T>(T message) {
        wire::Filler<RandomSource>(source).message(message);
        write_line(std::string(wire::layout<T>.name), encode(message), fields_of(message));
    };
    for (int round = 0; round < 5; ++round) (one(M{}), ...);
}

}  // namespace
}  // namespace echoloop

int main() {
    using namespace echoloop;
    RandomSource source;
    write_all(static_cast<seanet::Message*>(nullptr), source,
              [](const seanet::Message& message) { return seanet::encode(message); });
    write_all(static_cast<r2sonic::Packet*>(nullptr), source,
              [](const r2sonic::Packet& packet) { return r2sonic::serialise(packet); });
}
