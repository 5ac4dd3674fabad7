// Whatever is asked for, what waits for its faults takes bounded memory.
#include <gtest/gtest.h>

#include "emulator/faults/pieces.h"

namespace echoloop {
namespace {

constexpr std::size_t most = std::size_t{128} << 20;

Fault fault_of(const std::string& kind, const Options& given) {
    const FaultRow& row = *find_fault(kind);
    Fault fault;
    fault.device = "sonar";
    fault.kind = row.kind;
    for (const Option& parameter : row.parameters) fault.parameters[parameter.name] = parameter.default_value;
    for (const auto& [name, value] : given) fault.parameters.at(name) = value;
    return fault;
}

struct PiecesMemory : testing::Test {
    Faults faults{7, "test.yaml", nullptr};
    Pieces pieces{faults.of("sonar"), {"sonar", "line", Towards::to_driver}, {}};

    std::size_t memory_of_all(Time now) {
        std::size_t memory = 0;
        while (const auto piece = pieces.take(now))
            memory += sizeof(Piece) + piece->bytes.size() + piece->events.size() * sizeof(FaultEvent);
        return memory;
    }
};

TEST_F(PiecesMemory, OfCopiesWithAnEventForEveryByte) {
    faults.add(fault_of("latency", {{"delay", 60.0}}));
    for (int i = 0; i < 30; ++i)
        faults.add(fault_of("duplication", {{"rate", 1.0}, {"copies", std::int64_t{100}}}));
    faults.add(fault_of("bit_flips", {{"rate", 1.0}}));
    for (int i = 0; i < 20; ++i) pieces.add(Bytes(5000), {}, {});
    EXPECT_GT(pieces.dropped_bytes(), 0u);
    EXPECT_LT(memory_of_all(from_seconds(61)), most);
    EXPECT_TRUE(pieces.idle());
}

TEST_F(PiecesMemory, OfLostMessagesBehindALateOne) {
    faults.add(fault_of("latency", {{"delay", 60.0}}));
    pieces.add(Bytes(1), {}, {});
    faults.add(fault_of("loss", {{"rate", 1.0}}));
    for (int i = 0; i < 1'000'000; ++i) pieces.add(Bytes(1), {}, {});
    EXPECT_GT(pieces.dropped_bytes(), 0u);
    EXPECT_LT(memory_of_all(from_seconds(61)), most);
}

TEST_F(PiecesMemory, OfLargeMessagesThatWaitToBeMergedOrOvertaken) {
    for (const char* kind : {"merge", "reordering"}) {
        const bool merge = kind == std::string_view("merge");
        const int id = faults.add(merge ? fault_of(kind, {{"messages", std::int64_t{1000}}, {"within", 60.0}})
                                        : fault_of(kind, {{"rate", 1.0}, {"within", 60.0}}));
        const auto dropped = pieces.dropped_bytes();
        for (int i = 0; i < 500; ++i) pieces.add(Bytes(1 << 20), {}, {});
        EXPECT_GT(pieces.dropped_bytes(), dropped) << kind;
        EXPECT_LT(memory_of_all(from_seconds(61)), most) << kind;
        faults.clear(id);
    }
}

}  // namespace
}  // namespace echoloop
