// A driver's test in C++: it starts the emulator, reads where the sonar listens, and talks to it.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <nlohmann/json.hpp>

struct Emulator {
    FILE* out = popen("echo $$; exec " ECHOLOOP " run " SCENARIO " --json", "r");
    pid_t pid = std::stoi(line());
    nlohmann::json started = nlohmann::json::parse(line());  // comes when all is ready
    ~Emulator() { kill(pid, SIGINT), pclose(out); }

    std::string line() {
        std::string text;
        for (int c = 0; (c = fgetc(out)) != EOF && c != '\n';) text += static_cast<char>(c);
        return text;
    }
};

TEST(Ping1d, TellsTheVersionOfItsProtocol) {
    Emulator emulator;
    const auto port = emulator.started["devices"][0]["ports"][0]["port"].get<std::uint16_t>();

    const int driver = socket(AF_INET, SOCK_DGRAM, 0);  // from here on it is your driver's business
    sockaddr_in sonar{AF_INET, htons(port), {htonl(INADDR_LOOPBACK)}, {}};
    ASSERT_EQ(connect(driver, reinterpret_cast<sockaddr*>(&sonar), sizeof sonar), 0);
    ASSERT_EQ(send(driver, "BR\2\0\6\0\0\0\5\0\xA1\0", 12, 0), 12);
    std::array<char, 100> reply{};
    ASSERT_EQ(recv(driver, reply.data(), reply.size(), 0), 14);
    EXPECT_EQ(reply[4], 5);  // the message protocol_version
    EXPECT_EQ(reply[8], 1);  // its major
    close(driver);
}
