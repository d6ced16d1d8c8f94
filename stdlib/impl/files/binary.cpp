// Manual 1.10: bytes, strings, rawbytes and values of any type in files and devices.

#include "runtime/value/value_text.h"
#include "stdlib/impl/files/open_files.h"
#include "stdlib/impl/rawbytes/checks.h"
#include "stdlib/impl/rawbytes/raw_bytes.h"
#include "stdlib/impl/support/fail.h"

#include "natives/devices.h"
#include "natives/rawbytes.h"
#include "stdlib_constants.h"

#include <boost/crc.hpp>
#include <fmt/format.h>

#include <array>
#include <cmath>

using namespace rt;
using lib::Reading;

namespace {

/// The format of WriteAnyBin: this head, then the value as RAPID text.
struct AnyHead {
    std::array<char, 4> mark = {'R', 'A', 'n', 'y'};
    uint32_t size = 0;  ///< of the text
    uint32_t check = 0; ///< CRC-32 of the type and the text
};
static_assert(sizeof(AnyHead) == 12);

constexpr uint32_t kLongestText = 256u << 20;

uint32_t checkOf(const TypeDesc& type, std::string_view text) {
    const std::string described = describeType(type);
    boost::crc_32_type crc;
    crc.process_bytes(described.data(), described.size() + 1); // the zero at its end, too
    crc.process_bytes(text.data(), text.size());
    return crc.checksum();
}

Status endOfFile(TaskCore* task, Reading& reading, std::string_view what) {
    return lib::fail(task, err::ERR_RANYBIN_EOF,
                     fmt::format("{}: the file ended {}", reading.file().name(), what));
}

Status damaged(TaskCore* task, Reading& reading) {
    return lib::fail(
        task, err::ERR_RANYBIN_CHK,
        fmt::format(
            "{}: the bytes that follow were not written by WriteAnyBin for data of this type, or they "
            "have changed since",
            reading.file().name()));
}

/// Head and text are consumed together, so that reading again after an error of time begins at the head again.
Status readAny(TaskCore* task, Reading& reading, void* data, const TypeDesc& type) {
    AnyHead head;
    const AnyHead expected;
    if (const Status status = reading.untilSize(sizeof head)) return status;
    if (reading.buffered().size() < sizeof head) {
        reading.file().consume(reading.buffered().size());
        return endOfFile(task, reading, "before the value");
    }
    std::memcpy(&head, reading.buffered().data(), sizeof head);
    if (head.mark != expected.mark || head.size > kLongestText) {
        reading.file().consume(sizeof head);
        return damaged(task, reading);
    }
    const std::size_t whole = sizeof head + head.size;
    if (const Status status = reading.untilSize(whole)) return status;
    if (reading.buffered().size() < whole) {
        reading.file().consume(reading.buffered().size());
        return endOfFile(task, reading, "within the value");
    }
    const std::string text(reading.buffered().substr(sizeof head, head.size));
    reading.file().consume(whole);
    if (checkOf(type, text) != head.check || !sourceToValue(text, data, type)) return damaged(task, reading);
    return kOk;
}

} // namespace

extern "C" {

Status rt_WriteBin(TaskCore* task, Handle* IODevice, const float* Buffer, int32_t BufferDim1, float NChar) {
    if (!(NChar >= 0 && NChar <= static_cast<float>(BufferDim1)) || std::trunc(NChar) != NChar)
        return lib::failWith(task, err::ERR_ARGVALERR,
                             "NChar must be a whole number from 0 to {}, the size of the array", BufferDim1);
    std::string bytes(static_cast<std::size_t>(NChar), '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (!(Buffer[i] >= 0 && Buffer[i] <= 255) || std::trunc(Buffer[i]) != Buffer[i])
            return lib::failWith(task, err::ERR_ARGVALERR,
                                 "element {} is {}: bytes are whole numbers from 0 to 255",
                                 static_cast<double>(i + 1), static_cast<double>(Buffer[i]));
        bytes[i] = static_cast<char>(static_cast<unsigned char>(Buffer[i]));
    }
    return lib::writeTo(task, *IODevice, bytes);
}

Status rt_WriteStrBin(TaskCore* task, Handle* IODevice, const String* Str) {
    return lib::writeTo(task, *IODevice, Str->view());
}

Status rt_WriteAnyBin(TaskCore* task, Handle* IODevice, const void* Data, const TypeDesc* DataType) {
    std::string text;
    if (!valueToSource(Data, *DataType, text) || text.size() > kLongestText)
        return lib::fail(task, err::ERR_ARGVALERR,
                         fmt::format("a value of type {} cannot be written", DataType->name));
    AnyHead head;
    head.size = static_cast<uint32_t>(text.size());
    head.check = checkOf(*DataType, text);
    return lib::writeTo(task, *IODevice,
                        std::string(reinterpret_cast<const char*>(&head), sizeof head) + text);
}

Status rt_WriteRawBytes(TaskCore* task, Handle* IODevice, data::Rawbytes* RawData, const float* NoOfBytes) {
    uint32_t count = RawData->length;
    if (NoOfBytes != nullptr && !lib::toIndex(*NoOfBytes, count)) return lib::notAnIndex(task, "NoOfBytes");
    if (count > RawData->length) return lib::beyondValid(task, 1, count, RawData->length);
    return lib::writeTo(task, *IODevice, {reinterpret_cast<const char*>(RawData->bytes), count});
}

Status rt_ReadAnyBin(TaskCore* task, Handle* IODevice, void* Data, const TypeDesc* DataType,
                     const float* Time) {
    Reading reading(task, *IODevice, Time);
    return reading.status() != kOk ? reading.status() : readAny(task, reading, Data, *DataType);
}

/// From a file as many bytes as a container holds; a device gives what has come.
Status rt_ReadRawBytes(TaskCore* task, Handle* IODevice, data::Rawbytes* RawData, const float* Time) {
    Reading reading(task, *IODevice, Time);
    if (reading.status() != kOk) return reading.status();
    const std::size_t wanted = reading.file().isDevice() ? 1 : lib::kRawBytesCapacity;
    if (const Status status = reading.untilSize(wanted)) return status;
    const std::string_view bytes = reading.buffered().substr(0, lib::kRawBytesCapacity);
    lib::assign(*RawData, {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
    reading.file().consume(bytes.size());
    return bytes.size() < wanted ? endOfFile(task, reading, "before 1024 bytes were read") : kOk;
}

Status rt_ReadBin(TaskCore* task, float* result, Handle* IODevice, const float* Time) {
    Reading reading(task, *IODevice, Time);
    if (reading.status() != kOk) return reading.status();
    if (const Status status = reading.untilSize(1)) return status;
    const std::string_view bytes = reading.buffered();
    *result = bytes.empty() ? k::EOF_BIN : static_cast<float>(static_cast<unsigned char>(bytes[0]));
    if (!bytes.empty()) reading.file().consume(1);
    return kOk;
}

Status rt_ReadStrBin(TaskCore* task, String* result, Handle* IODevice, float NoOfChars, const float* Time) {
    if (!(NoOfChars >= 1 && NoOfChars <= kStringCapacity) || std::trunc(NoOfChars) != NoOfChars)
        return lib::fail(task, err::ERR_ARGVALERR, "NoOfChars must be a whole number from 1 to 80");
    Reading reading(task, *IODevice, Time);
    if (reading.status() != kOk) return reading.status();
    const auto count = static_cast<std::size_t>(NoOfChars);
    if (const Status status = reading.untilSize(count)) return status;
    const std::string_view bytes = reading.buffered().substr(0, count);
    result->assign(bytes.empty() ? std::string_view("EOF") : bytes);
    reading.file().consume(bytes.size());
    return kOk;
}
}
