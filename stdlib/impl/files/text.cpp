// Manual 1.10: text in files and devices, line by line.

#include "runtime/value/value_text.h"
#include "stdlib/impl/files/open_files.h"
#include "stdlib/impl/files/places.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/utf8.h"
#include "stdlib/impl/support/written_value.h"

#include "natives/devices.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <bitset>
#include <cmath>
#include <limits>

using namespace rt;
using lib::Reading;

namespace {

using Delimiters = std::bitset<256>;

constexpr std::size_t kMost = kStringCapacity;

/// A line feed always ends an item. With \Delim its characters do, too, and carriage returns.
Delimiters delimitersOf(const String* delim) {
    Delimiters set;
    set.set('\n');
    if (delim == nullptr) return set;
    set.set('\r');
    for (const char c : delim->view())
        set.set(static_cast<unsigned char>(c));
    return set;
}

std::size_t firstOf(const Delimiters& set, std::string_view text) {
    std::size_t i = 0;
    while (i < text.size() && !set[static_cast<unsigned char>(text[i])])
        ++i;
    return i;
}

/// Passes over delimiters.
Status skip(Reading& reading, const Delimiters& set) {
    for (;;) {
        if (const Status status = reading.untilSize(1)) return status;
        const std::string_view text = reading.buffered();
        std::size_t count = 0;
        while (count < text.size() && set[static_cast<unsigned char>(text[count])])
            ++count;
        reading.file().consume(count);
        if (count < text.size() || reading.atEnd()) return kOk;
    }
}

struct Item {
    String text;
    bool none = false;    ///< the file was at its end
    bool remains = false; ///< more than fits into a string: the rest comes with the next item
};

/// Reads up to the next delimiter, which is skipped, and at most 80 bytes.
Status readItem(Reading& reading, const Delimiters& set, bool removeCr, Item& item) {
    // A carriage return that is removed and the delimiter after it do not count.
    const std::size_t looked = kMost + (removeCr ? 2 : 1);
    const auto isEnough = [&set, looked](std::string_view text) {
        return text.size() >= looked || firstOf(set, text) < text.size();
    };
    if (const Status status = reading.until(isEnough)) return status;
    const std::string_view buffered = reading.buffered().substr(0, looked);
    const std::size_t end = firstOf(set, buffered);
    std::string_view text = buffered.substr(0, end);
    if (removeCr && !text.empty() && text.back() == '\r' && (end < buffered.size() || reading.atEnd()))
        text.remove_suffix(1);
    item.none = buffered.empty();
    item.remains = text.size() > kMost;
    if (item.remains) text = lib::cutToString(text);
    item.text.assign(text);
    reading.file().consume(item.remains ? text.size() : std::min(end + 1, buffered.size()));
    return kOk;
}

/// To the beginning of a line, counted from 1; to the end when there are fewer.
Status goToLine(TaskCore* task, Reading& reading, float line) {
    if (!(line >= 1) || std::trunc(line) != line)
        return lib::fail(task, err::ERR_ARGVALERR, "\\Line must be a whole number from 1");
    if (const std::string problem = reading.file().rewind(); !problem.empty())
        return lib::fail(task, err::ERR_FILEACC, fmt::format("{}: {}", reading.file().name(), problem));
    for (auto left = static_cast<int64_t>(line) - 1; left > 0;) {
        if (const Status status = reading.untilSize(1)) return status;
        const std::string_view text = reading.buffered();
        if (text.empty()) break;
        const std::size_t end = text.find('\n');
        if (end != std::string_view::npos) --left;
        reading.file().consume(end == std::string_view::npos ? text.size() : end + 1);
    }
    return kOk;
}

/// The next number of a text. `number` stays as it is at the end of the file.
Status readNumber(TaskCore* task, Handle handle, const String* delim, const float* time, double most,
                  double& number) {
    Reading reading(task, handle, time);
    if (reading.status() != kOk) return reading.status();
    Delimiters set = delimitersOf(delim);
    set.set('\r'); // files of PCs
    if (const Status status = skip(reading, set)) return status;
    Item item;
    if (const Status status = readItem(reading, set, false, item)) return status;
    double value = 0;
    if (item.none) return kOk;
    if (!parseRapidNumber(item.text.view(), value) || !(std::fabs(value) <= most))
        return lib::fail(
            task, err::ERR_RCVDATA,
            fmt::format("{}: \"{}\" is not a number", reading.file().name(), lib::shown(item.text.view())));
    number = value;
    return kOk;
}

} // namespace

extern "C" {

Status rt_Write(TaskCore* task, Handle* IODevice, const String* String, const float* Num, const bool* Bool,
                const data::Pos* Pos, const data::Orient* Orient, const double* Dnum, bool NoNewLine) {
    if (Num == nullptr && Bool == nullptr && Pos == nullptr && Orient == nullptr && Dnum == nullptr) {
        char line[kStringCapacity + 1];
        const std::size_t size = String->size();
        std::memcpy(line, String->bytes, size);
        line[size] = '\n';
        return lib::writeTo(task, *IODevice, {line, size + (NoNewLine ? 0 : 1)});
    }
    std::string line = lib::withValue(*String, Num, Bool, Pos, Orient, Dnum);
    if (!NoNewLine) line += '\n';
    return lib::writeTo(task, *IODevice, line);
}

Status rt_ReadStr(TaskCore* task, String* result, Handle* IODevice, const String* Delim, bool RemoveCR,
                  bool DiscardHeaders, const float* Time, const float* Line, String* Status) {
    Reading reading(task, *IODevice, Time);
    if (reading.status() != kOk) return reading.status();
    if (Line != nullptr)
        if (const rt::Status status = goToLine(task, reading, *Line)) return status;
    const Delimiters set = delimitersOf(Delim);
    if (DiscardHeaders)
        if (const rt::Status status = skip(reading, set)) return status;
    Item item;
    if (const rt::Status status = readItem(reading, set, RemoveCR, item)) return status;
    if (item.none) item.text.assign("EOF");
    *result = item.text;
    if (Status != nullptr) Status->assign(item.remains ? "REMAIN" : "");
    return kOk;
}

Status rt_ReadNum(TaskCore* task, float* result, Handle* IODevice, const String* Delim, const float* Time) {
    double number = static_cast<double>(k::EOF_NUM);
    const Status status = readNumber(task, *IODevice, Delim, Time,
                                     static_cast<double>(std::numeric_limits<float>::max()), number);
    *result = static_cast<float>(number);
    return status;
}

Status rt_ReadDnum(TaskCore* task, double* result, Handle* IODevice, const String* Delim, const float* Time) {
    *result = 9.998E36; // EOF_NUM, as a program writes it
    return readNumber(task, *IODevice, Delim, Time, std::numeric_limits<double>::max(), *result);
}
}
