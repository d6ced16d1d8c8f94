#include "runtime/sim/csv_writers.h"

#include "runtime/base/text_util.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

namespace rt {
namespace {

/// Fixed decimals; what rounds to zero has no sign, so that the last bit of a sum never shows.
void appendFixed(std::string& line, double value, int decimals) {
    const double half = 0.5 * std::pow(10.0, -decimals);
    if (std::fabs(value) < half) value = 0;
    fmt::format_to(std::back_inserter(line), ",{:.{}f}", value, decimals);
}

} // namespace

bool SignalsWriter::open(const std::string& path, std::string& error) {
    if (!file_.open(path, error)) return false;
    file_.write("time_s,signal,value\n");
    return true;
}

void SignalsWriter::change(Time time, std::string_view signal, double value) {
    file_.write(fmt::format("{},{},{}\n", formatSeconds(time, 6), signal, shortestNumber(value)));
}

bool ErrorsWriter::open(const std::string& path, std::string& error) {
    if (!file_.open(path, error)) return false;
    file_.write("time_s,task,module,routine,line,column,number,name,file\n");
    return true;
}

void ErrorsWriter::raised(Time time, std::string_view task, const SourcePlace& place, int number,
                          std::string_view name) {
    file_.write(fmt::format("{},{},{},{},{},{},{},{},\"{}\"\n", formatSeconds(time, 6), task, place.module,
                            place.routine, place.line, place.column, number, name, place.file));
}

bool TraceWriter::open(const std::string& path, std::string& error) {
    if (!file_.open(path, error)) return false;
    file_.write("time_s,unit,j1,j2,j3,j4,j5,j6,e1,e2,e3,e4,e5,e6,x,y,z,q1,q2,q3,q4,speed_mm_s,move");
    file_.write(withMotors_ ? ",m1,m2,m3,m4,m5,m6\n" : "\n");
    return true;
}

void TraceWriter::sample(Time time, std::string_view unit, const motion::MotionState& state) {
    const int digits = time % kMillisecond == 0 ? 3 : 6; // exact with any --tick
    std::string line = fmt::format("{},{}", formatSeconds(time, digits), unit);
    for (const double axis : state.numberedAxes()) {
        if (motion::isConnected(axis))
            appendFixed(line, axis, 6);
        else
            line += ",9E+09"; // as RAPID writes an axis that is not there
    }
    for (const double length : {state.tcp.pos.x, state.tcp.pos.y, state.tcp.pos.z})
        appendFixed(line, length, 6);
    for (const double q : {state.tcp.rot.w, state.tcp.rot.x, state.tcp.rot.y, state.tcp.rot.z}) {
        appendFixed(line, q, 9);
    }
    appendFixed(line, state.tcpSpeed, 4);
    fmt::format_to(std::back_inserter(line), ",{}", state.tag);
    if (withMotors_) {
        std::array<double, 6> motors{}; // of axes that the arm does not have: 0
        for (std::size_t i = 0; i < state.motors.size(); ++i)
            if (state.axisNumbers[i] <= motors.size()) motors[state.axisNumbers[i] - 1U] = state.motors[i];
        for (const double motor : motors)
            appendFixed(line, motor, 6);
    }
    line += '\n';
    file_.write(line);
}

} // namespace rt
