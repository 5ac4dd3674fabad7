#include "emulator/machine/steal.h"

#include <unistd.h>

#include <fstream>
#include <string>

namespace echoloop {

/// By proc(5): "cpu", then the time spent in user mode, nice, system, idle, iowait, irq, softirq and steal,
/// in ticks.
double stolen_seconds() {
    std::ifstream file("/proc/stat");
    std::string cpu;
    double user = 0, nice = 0, system = 0, idle = 0, iowait = 0, irq = 0, softirq = 0, steal = 0;
    file >> cpu >> user >> nice >> system >> idle >> iowait >> irq >> softirq >> steal;
    return file ? steal / static_cast<double>(::sysconf(_SC_CLK_TCK)) : 0;
}

}  // namespace echoloop
