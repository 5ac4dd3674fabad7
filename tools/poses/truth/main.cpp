// echoloop-truth-rosbridge: what is really before each sonar, as pictures and points in ROS 1 or ROS 2,
// through a rosbridge server.
#include <poll.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>
#include <cstdio>
#include <map>
#include <set>

#include "emulator/contract/error.h"
#include "tools/poses/common/program.h"
#include "tools/poses/common/say.h"
#include "tools/poses/common/stop.h"
#include "tools/poses/rosbridge/connection.h"
#include "tools/poses/truth/messages.h"

namespace echoloop::poses {
namespace {

constexpr auto name = "echoloop-truth-rosbridge";
constexpr std::size_t longest_line = 32 << 20;  // bytes

using Steady = std::chrono::steady_clock;

struct TruthOptions {
    std::string server = "ws://127.0.0.1:9090", prefix = "/echoloop";
    TruthWords words;
    double rate = 5;  ///< pictures a second of a sonar, at most
    int width = 400;  ///< px
};

/// Topics take letters, digits and underscores.
std::string topic_name(const std::string& device) {
    std::string text;
    for (const char c : device) text += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return text.empty() || std::isdigit(static_cast<unsigned char>(text[0])) ? "sonar_" + text : text;
}

class Publisher {
  public:
    explicit Publisher(const TruthOptions& options) : options_(options), connection_(options.server) {}

    /// Keeps the connection; tries to get it back every second.
    void serve() {
        if (connection_.is_open()) {
            connection_.read(1);  // ms: what it says is of no use, but its pings and its end are heard
            if (!connection_.is_open())
                say(options_.server + ": " + connection_.why() + "; trying to connect again");
            return;
        }
        if (Steady::now() < next_try_) return;
        const bool open = connection_.open();
        next_try_ = Steady::now() + std::chrono::seconds(1);
        if (open) {
            advertised_.clear();
            said_ = false;
            say("publishing to " + options_.server + " below " + options_.prefix + "; Ctrl-C ends");
        } else if (!std::exchange(said_, true)) {
            say(options_.server + ": " + connection_.why() +
                "; trying until a rosbridge server listens there");
        }
    }

    void heard(std::string_view line) {
        TruthLine read = read_truth(line);
        if (!read.reason.empty()) {
            if (refused_++ == 0) say("a line was refused: " + harmless(read.reason));
            return;
        }
        if (!read.ping) return;
        if (!connection_.is_open()) {
            ++unheard_;
            return;
        }
        publish(std::move(*read.ping));
    }
    void too_long() {
        if (refused_++ == 0) say("a line was refused: it is longer than 32 MiB");
    }

    void print_summary() const {
        std::printf("pings     %llu\npictures  %llu\npoints    %llu\n",
                    static_cast<unsigned long long>(pings_), static_cast<unsigned long long>(pictures_),
                    static_cast<unsigned long long>(points_));
        if (unheard_ > 0)
            std::printf("unheard   %llu pings, while there was no server\n",
                        static_cast<unsigned long long>(unheard_));
        if (refused_ > 0) std::printf("refused   %llu lines\n", static_cast<unsigned long long>(refused_));
    }

  private:
    struct Sonar {
        TruthPicture picture;
        double next_picture = 0;  ///< s since 1970
    };

    std::string topic(const std::string& device, const char* what) {
        std::string out = options_.prefix + "/" + topic_name(device) + "/" + what;
        const char* type = what == std::string_view("truth_image")    ? "sensor_msgs/Image"
                           : what == std::string_view("truth_points") ? "sensor_msgs/PointCloud2"
                                                                      : "geometry_msgs/PoseStamped";
        if (advertised_.insert(out).second) connection_.write(advertise_request(options_.words, out, type));
        return out;
    }

    void publish(TruthPing ping) {
        ++pings_;
        const std::string device = ping.device;
        connection_.write(points_message(options_.words, topic(device, "truth_points"), ping));
        connection_.write(pose_message(options_.words, topic(device, "truth_pose"), ping));
        for (const TruthBeam& beam : ping.beams) points_ += beam.range.has_value();
        const double now = ping.unix_time;
        Sonar& sonar = sonars_[device];
        sonar.picture.add(std::move(ping));
        if (now < sonar.next_picture) return;
        sonar.next_picture = now + 1 / options_.rate;
        connection_.write(image_message(options_.words, topic(device, "truth_image"), now, topic_name(device),
                                        sonar.picture.draw(options_.width)));
        ++pictures_;
    }

    const TruthOptions& options_;
    Connection connection_;
    Steady::time_point next_try_{};
    bool said_ = false;
    std::set<std::string> advertised_;
    std::map<std::string, Sonar> sonars_;
    std::uint64_t pings_ = 0, pictures_ = 0, points_ = 0, unheard_ = 0, refused_ = 0;
};

/// Lines from standard input, until its end or a signal.
void listen(Publisher& publisher) {
    std::string waiting;
    bool overlong = false;
    char piece[1 << 16];
    while (!stopped()) {
        publisher.serve();
        pollfd ready{STDIN_FILENO, POLLIN, 0};
        if (::poll(&ready, 1, 100) <= 0) continue;
        const ssize_t size = ::read(STDIN_FILENO, piece, sizeof piece);
        if (size == 0) return;
        if (size < 0) continue;
        waiting.append(piece, static_cast<std::size_t>(size));
        std::size_t from = 0;
        for (std::size_t end; (end = waiting.find('\n', from)) != std::string::npos; from = end + 1)
            if (!std::exchange(overlong, false))
                publisher.heard(std::string_view(waiting).substr(from, end - from));
        waiting.erase(0, from);
        if (waiting.size() <= longest_line) continue;
        if (!std::exchange(overlong, true)) publisher.too_long();
        waiting.clear();
    }
}

/// False if help or version was asked for.
bool read_options(int argc, char** argv, TruthOptions& options) {
    CLI::App app(
        "Publishes the ground truth of a running echoloop in ROS 1 or ROS 2 through a rosbridge server: of "
        "each\n"
        "sonar the objects before it as a picture (sensor_msgs/Image), where its beams end (PointCloud2, "
        "with the\n"
        "object's number), and its pose (PoseStamped).",
        name);
    app.set_version_flag("--version", std::string(name) + " " ECHOLOOP_VERSION);
    app.add_option("--server", options.server, "rosbridge's address (default " + options.server + ")")
        ->type_name("URL");
    app.add_option("--prefix", options.prefix,
                   "what the topics' names begin with (default " + options.prefix + ")")
        ->type_name("NAME");
    app.add_option("--world", options.words.world, "frame of points and poses (default map)")
        ->type_name("FRAME");
    app.add_option("--ros", options.words.ros, "generation whose words are used (default 2)")
        ->type_name("1|2")
        ->check(CLI::IsMember({1, 2}));
    app.add_option("--rate", options.rate, "pictures a second of each sonar, at most (default 5)")
        ->type_name("HZ")
        ->check(CLI::Range(0.01, 100.0));
    app.add_option("--width", options.width, "of a picture (default 400)")
        ->type_name("PIXELS")
        ->check(CLI::Range(16, 2000));
    app.footer(
        "Examples:\n"
        "  echoloop run demo --truth >(echoloop-truth-rosbridge)            # in bash\n"
        "  mkfifo /tmp/truth; echoloop-truth-rosbridge --ros 1 < /tmp/truth & echoloop run demo --truth "
        "/tmp/truth\n"
        "  echoloop-truth-rosbridge < dive.jsonl                            # of a run that is over\n");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success))
            throw StartError(Exit::usage, std::string(error.what()) + "; see " + name + " --help");
        app.exit(error);
        return false;
    }
    return true;
}

void publish_truth(int argc, char** argv) {
    TruthOptions options;
    if (!read_options(argc, argv, options)) return;
    catch_signals();
    Publisher publisher(options);
    listen(publisher);
    publisher.print_summary();
}

}  // namespace
}  // namespace echoloop::poses

int main(int argc, char** argv) {
    using namespace echoloop::poses;
    return exit_status(name, [&] { publish_truth(argc, argv); });
}
