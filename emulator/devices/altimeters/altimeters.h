// Altimeters on a line of their own, each in its maker's words.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emulator/devices/altimeters/altimeter.h"
#include "emulator/devices/altimeters/settings.h"

namespace echoloop::altimeters {

using Wiring = std::vector<echosounder::Wiring>;

/// Streams until '#' stops it; then it answers commands, each with an echo, a value and '>'.
class ValeportVa500 final : public Altimeter {
  public:
    ValeportVa500(const Valeport& settings, Wiring wiring);
    Actions received(const Received& data, Time now) override;

  private:
    std::vector<std::string> lines(std::optional<double> metres, Time now) override;
    void hear(char c, Time now);
    void obey(const std::string& line, Time now);
    bool run(const std::string& mode, Time now);
    /// What stands between echo and '>'; nothing: it knows no such command.
    std::optional<std::string> answer(int number, const std::string& value);
    std::string sentence(double metres, Time now) const;
    std::string told_mode() const;

    Valeport settings_;
    bool running_, single_ = false;
    double shortest_ = 0.1;  ///< m, #840
    std::string line_, range_unit_ = "M";
    std::optional<double> last_;  ///< m
};

/// 'Z', or its letter, asks for one line; 'F' lets it run freely.
class TritechPa final : public Altimeter {
  public:
    TritechPa(const Tritech& settings, Wiring wiring);
    Actions received(const Received& data, Time now) override;

  private:
    std::vector<std::string> lines(std::optional<double> metres, Time now) override;
    Tritech settings_;
};

/// It listens to nobody.
class BenthosPsa916 final : public Altimeter {
  public:
    BenthosPsa916(const Benthos& settings, Wiring wiring);

  private:
    std::vector<std::string> lines(std::optional<double> metres, Time now) override;
    Benthos settings_;
    double last_ = 0;  ///< m
    int missed_;       ///< in a row
};

/// Commands are texts that end with CR, LF or a silence; '#' alone stops it.
class EchologgerEct final : public Altimeter {
  public:
    EchologgerEct(const Echologger& settings, Wiring wiring);
    Actions received(const Received& data, Time now) override;
    Actions woken(Time now) override;

  private:
    std::vector<std::string> lines(std::optional<double> metres, Time now) override;
    void obey(const std::string& text, Time now);
    bool set(const std::string& name, double value);

    Echologger settings_;
    bool running_ = true, tells_dpt_ = true, tells_mtw_ = true;
    std::string text_;
};

/// Four bytes: FF, time of flight, level. It listens to nobody.
class Imagenex863 final : public Altimeter {
  public:
    Imagenex863(const Imagenex& settings, Wiring wiring)
        : Altimeter(settings.sounding, std::move(wiring)), settings_(settings) {}

  private:
    std::vector<std::string> lines(std::optional<double> metres, Time now) override;
    Imagenex settings_;
};

/// The rows of the table of models.
std::vector<Model> models();

}  // namespace echoloop::altimeters
