// Manual 1.10: length, clearing and copying of rawbytes, headers of DeviceNet messages.

#include "stdlib/impl/rawbytes/raw_bytes.h"
#include "stdlib/impl/rawbytes/checks.h"
#include "stdlib/impl/support/fail.h"

#include "natives/rawbytes.h"
#include "stdlib_constants.h"

#include <charconv>
#include <string>

using namespace rt;

namespace {

constexpr uint8_t kDeviceNetFormat =
    1; // the controller's own code; what it is on a real one is not published

bool isHexByte(std::string_view text) {
    unsigned value = 0;
    return text.size() == 2 &&
           std::from_chars(text.data(), text.data() + 2, value, 16).ptr == text.data() + 2;
}

/// "6,20 1D 24 01 30 64,8,1" (as in an EDS file) or "20 1D 24 01 30 64": the path itself.
std::string_view pathOf(std::string_view text) {
    const std::size_t begin = text.find(',');
    if (begin == std::string_view::npos) return text;
    text.remove_prefix(begin + 1);
    return text.substr(0, text.find(','));
}

bool isPath(std::string_view path) {
    while (path.size() > 2 && isHexByte(path.substr(0, 2)) && path[2] == ' ')
        path.remove_prefix(3);
    return isHexByte(path);
}

} // namespace

extern "C" {

Status rt_RawBytesLen(TaskCore*, float* result, data::Rawbytes* RawData) {
    *result = static_cast<float>(RawData->length);
    return kOk;
}

Status rt_ClearRawBytes(TaskCore* task, data::Rawbytes* RawData, const float* FromIndex) {
    uint32_t first = 1;
    if (FromIndex != nullptr && !lib::toIndex(*FromIndex, first)) return lib::notAnIndex(task, "FromIndex");
    if (first <= RawData->length) lib::setLength(*RawData, first - 1);
    return kOk;
}

Status rt_CopyRawBytes(TaskCore* task, data::Rawbytes* FromRawData, float FromIndex,
                       data::Rawbytes* ToRawData, float ToIndex, const float* NoOfBytes) {
    uint32_t from = 0, to = 0;
    if (!lib::toIndex(FromIndex, from)) return lib::notAnIndex(task, "FromIndex");
    if (!lib::toIndex(ToIndex, to)) return lib::notAnIndex(task, "ToIndex");
    const uint32_t valid = FromRawData->length;
    uint32_t count = from <= valid ? valid - from + 1 : 0;
    if (NoOfBytes != nullptr && !lib::toIndex(*NoOfBytes, count)) return lib::notAnIndex(task, "NoOfBytes");
    if (from - 1 + count > valid) return lib::beyondValid(task, from, count, valid);
    if (to - 1 + count > lib::kRawBytesCapacity) return lib::beyondCapacity(task, to, count);
    lib::put(*ToRawData, to - 1, FromRawData->bytes + from - 1, count);
    return kOk;
}

Status rt_PackDNHeader(TaskCore* task, const String* Service, const String* Path, data::Rawbytes* RawData) {
    const std::string_view path = pathOf(Path->view());
    if (!isHexByte(Service->view()))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the service must be two hexadecimal digits, such as \"0E\"");
    if (!isPath(path))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "the path must be hexadecimal bytes, such as \"20 1D 24 01 30 64\" or "
                         "\"6,20 1D 24 01 30 64,8,1\"");
    uint8_t service = 0;
    std::from_chars(Service->bytes, Service->bytes + 2, service, 16);
    const uint8_t head[] = {kDeviceNetFormat, service, static_cast<uint8_t>(path.size())};
    lib::setLength(*RawData, 0);
    lib::put(*RawData, 0, head, sizeof head);
    lib::put(*RawData, sizeof head, path.data(), path.size());
    return kOk;
}
}
