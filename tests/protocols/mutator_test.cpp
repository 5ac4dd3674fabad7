// What the fuzz targets' mutator makes: messages that framers still take, with fields, counts and lengths
// that are not those of the message it began with.
#include "tests/protocols/mutator.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/protocols/data.h"

namespace echoloop::fuzz {
namespace {

/// Instead of libFuzzer's, which is not there.
std::size_t one_bit(std::uint8_t* data, std::size_t size, std::size_t) {
    if (size != 0) data[size / 2] ^= 4;
    return size;
}

std::size_t whole_messages(const inspect::Family& family, ByteView bytes) {
    const auto is_whole = [](const inspect::Message& m) { return !m.name.empty(); };
    return static_cast<std::size_t>(std::ranges::count_if(family.decode(bytes), is_whole));
}

class MutatorOf : public testing::TestWithParam<std::string> {
  protected:
    const inspect::Family& family() const { return *inspect::find_family(GetParam()); }
};

TEST_P(MutatorOf, KeepsMessagesThatFramersTake) {
    for (const auto& path : hex_files(GetParam())) {
        const Bytes bytes = read_hex_file(path).bytes;
        const std::size_t least = family().checksums != nullptr ? 110 : 20;  // of 200; texts have to be exact
        std::size_t taken = 0, different = 0, sizes = 0;
        for (unsigned seed = 1; seed <= 200; ++seed) {
            Random random(seed);
            const Bytes changed = Mutator(family(), random, one_bit)(bytes, 100000);
            taken += whole_messages(family(), changed) != 0;
            different += changed != bytes;
            sizes += changed.size() != bytes.size();
        }
        EXPECT_GT(taken, least) << path;
        EXPECT_GT(different, 100) << path;
        EXPECT_GT(sizes, 4) << path;
    }
}

TEST_P(MutatorOf, ReachesEveryField) {
    for (const auto& path : hex_files(GetParam())) {
        const Bytes bytes = read_hex_file(path).bytes;
        const auto message = family().decode(bytes).at(0);
        std::set<std::string> missed;
        for (const auto& field : message.fields)
            if (field.size != 0 && field.offset + field.size <= bytes.size()) missed.insert(field.name);
        for (unsigned seed = 1; seed <= 50000 && !missed.empty(); ++seed) {
            Random random(seed);
            const Bytes changed = Mutator(family(), random, one_bit)(bytes, 100000);
            if (changed.size() != bytes.size()) continue;
            for (const auto& field : message.fields)
                if (!std::equal(bytes.begin() + static_cast<std::ptrdiff_t>(field.offset),
                                bytes.begin() + static_cast<std::ptrdiff_t>(field.offset + field.size),
                                changed.begin() + static_cast<std::ptrdiff_t>(field.offset)))
                    missed.erase(field.name);
        }
        EXPECT_TRUE(missed.empty()) << path << ": " << *missed.begin();
    }
}

TEST_P(MutatorOf, HoldsTheLimit) {
    const Bytes bytes = read_hex_file(hex_files(GetParam()).at(0)).bytes;
    for (unsigned seed = 1; seed <= 300; ++seed) {
        EXPECT_LE(mutated_records(bytes, bytes.size(), seed, {GetParam(), 3}, 2, one_bit).size(),
                  bytes.size());
        EXPECT_LE(mutated_records({}, 7, seed, {GetParam(), 3}, 2, one_bit).size(), 7);
        EXPECT_LE(mutated(bytes, bytes.size(), seed, {GetParam(), 1}, one_bit).size(), bytes.size());
        EXPECT_LE(mutated({}, 7, seed, {"", 1}, one_bit).size(), 7);
    }
}

INSTANTIATE_TEST_SUITE_P(Families, MutatorOf, testing::ValuesIn([] {
                             std::vector<std::string> names;
                             for (const auto& family : inspect::families()) names.emplace_back(family.name);
                             return names;
                         }()),
                         [](const auto& family) { return family.param; });

TEST(MutatedRecords, ChangeOneMessageAndLeaveTheOthers) {
    const Bytes request = read_hex_file(hex_files("ping").at(0)).bytes;
    const auto size = static_cast<std::uint8_t>(request.size());
    Bytes input{0, 0, 0x71};
    for (const std::uint8_t pause : {std::uint8_t{16}, std::uint8_t{17}}) {
        input.insert(input.end(), {0, pause, size});
        input.insert(input.end(), request.begin(), request.end());
    }
    std::size_t whole = 0, grown = 0;
    for (unsigned seed = 1; seed <= 300; ++seed) {
        const Bytes changed = mutated_records(input, 4096, seed, {"ping", 3}, 2, one_bit);
        std::size_t messages = 0, at = 3;
        for (; at + 2 < changed.size(); at += 3 + changed[at + 2])
            messages +=
                whole_messages(*inspect::find_family("ping"),
                               ByteView(changed).subspan(
                                   at + 3, std::min<std::size_t>(changed[at + 2], changed.size() - at - 3)));
        whole += at == changed.size() && messages >= 2;
        grown += changed.size() > input.size();
    }
    EXPECT_GT(whole, 120);
    EXPECT_GT(grown, 60);
}

TEST(Checksum, IsLeftOutWhereThereIsNoRoomForOne) {
    for (const auto& family : inspect::families())
        for (const std::string text : {"", "*", "*12", "$*", "$SDDPT*1", "BR", "RIP2"}) {
            Bytes message(text.begin(), text.end());
            set_checksum(family.name, message);
            EXPECT_EQ(message.size(), text.size());
        }
}

/// Those that stand in the table of what comes before every message, by number and name.
std::set<std::string> numbered(const inspect::Family& family) {
    std::set<std::string> tables, out;
    for (const auto& table : family.tables()) tables.insert(table.name);
    for (const auto& table : family.tables())
        for (const auto& row : table.rows)
            for (const auto& value : row.meta.names)
                if (tables.contains(std::string(value.name))) out.emplace(value.name);
    return out;
}

TEST(MadeMessage, IsReadAsWhatItsTableSays) {
    // A block with a length of its own, an image that has to fit, an answer that is not documented.
    const std::set<std::string> wants_more{"BBUserData", "Result", "FullResult"};
    for (const std::string name : {"ping", "cerulean", "seanet", "oculus", "norbit"}) {
        const auto& family = *inspect::find_family(name);
        std::set<std::string> missed = numbered(family);
        EXPECT_GE(missed.size(), 2U) << name;
        for (const auto& known : wants_more) missed.erase(known);
        for (unsigned seed = 1; seed <= 1000 && !missed.empty(); ++seed) {
            Random random(seed);
            MadeMessage made(family, random);
            for (const auto& table : made.tables())
                for (const auto& message : family.decode(made.of(table)))
                    if (message.reason.empty()) missed.erase(message.name);
        }
        for (const auto& left : missed) ADD_FAILURE() << name << ": " << left;
    }
}

}  // namespace
}  // namespace echoloop::fuzz
