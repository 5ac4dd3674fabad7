// Arbitrary messages for rapidcheck, and the lists of all messages that typed tests run over.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "protocols/r2sonic/layouts.h"
#include "protocols/seanet/layouts.h"
#include "tests/protocols/fill.h"

namespace echoloop {

struct RapidcheckSource {
    template <class T>
    T number() {
        return *rc::gen::arbitrary<T>();
    }
    std::size_t size() { return *rc::gen::inRange<std::size_t>(0, 40); }
};

/// Only inside a rapidcheck property.
template <class M>
M arbitrary() {
    RapidcheckSource source;
    M message{};
    wire::Filler<RapidcheckSource>(source).message(message);
    return message;
}

template <class Variant>
struct TypesOf;
template <class... T>
struct TypesOf<std::variant<T...>> {
    using type = ::testing::Types<T...>;
};
using SeanetTypes = TypesOf<seanet::Message>::type;
using R2SonicTypes = TypesOf<r2sonic::Packet>::type;

}  // namespace echoloop
